// `bendlab stiffness`: measures how stiff the cantilever strip of a run is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/json_text.hpp"
#include "experiments/cli/find_run.hpp"
#include "experiments/measures/strip.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

struct Row {
  const char* name;
  double value;
  const char *unit, *meaning;
};

std::vector<Row> rows_of(const StripStiffness& s, const StripOptions& options, double settling) {
  return {
      {"length", s.length, "m", "L, from the clamp's edge to the free end, at rest"},
      {"width", s.width, "m", "mean width along the strip"},
      {"clamp_offset", options.clamp_offset, "m", "how far behind the clamp's edge the strip begins to bend"},
      {"effective_length", s.effective_length, "m", "length + clamp_offset"},
      {"drop", s.drop, "m", "H: how far the free end hangs down"},
      {"reach", s.reach, "m",
       "W: horizontal distance of the free end from the clamp's edge, plus clamp_offset"},
      {"height_over_width", s.height_over_width, "1", "H / W"},
      {"settling", settling, "1", "range of H/W in the last tenth of the frames, divided by the last H/W"},
      {"stretch", s.stretch, "1", "stretch of the middle line"},
      {"gamma", s.gamma, "1", "ρ g L³ / B, computed from H/W for m = B κ"},
      {"amplification", s.amplification, "1", "d ln gamma / d ln H/W"},
      {"flexural_rigidity", s.flexural_rigidity, "N m", "B, if m = B κ"},
      {"bending_length", s.bending_length, "m", "(B / ρ g)^(1/3), as in ASTM D1388"},
      {"quartic_gamma", s.quartic_gamma, "1", "ρ g L⁵ / C, computed from H/W for m = C κ³"},
      {"quartic_amplification", s.quartic_amplification, "1", "d ln quartic_gamma / d ln H/W"},
      {"quartic", s.quartic, "N m³", "C, if m = C κ³ (springs)"},
      {"exclude", options.exclude, "m", "length at the clamp and at the free end that the fit leaves out"},
      {"fit_samples", static_cast<double>(s.fit.samples), "1",
       "triples of neighbouring slices to which m(κ) was fitted"},
      {"fit_exponent", s.fit.exponent, "1", "p of m = c κ^p: 1 linear, 3 springs"},
      {"fit_coefficient", s.fit.coefficient, "N m^p", "c of m = c κ^p"},
      {"fit_residual", s.fit.residual, "1", "root mean square of ln m - ln(c κ^p)"},
      {"fit_B", s.fit.rigidity, "N m", "geometric mean of m / κ"},
      {"fit_C", s.fit.quartic, "N m³", "geometric mean of m / κ³"}};
}

// The index of a frame; negative numbers count from the end.
std::int64_t frame_of(const RunRecord& record, int asked) {
  const auto frames = static_cast<std::int64_t>(record.frames);
  const std::int64_t frame = asked < 0 ? frames + asked : asked;
  if (frame < 0 || frame >= frames)
    throw UsageError(
        fmt::format("{}: there is no frame {}; the file has {}, the first is 0 and the last is -1",
                    record.file.string(), asked, counted(frames, "frame")));
  return frame;
}

RunConfig config_of(const RunRecord& record) {
  try {
    return stored_run(Json::parse(record.config));
  } catch (const std::exception& error) {
    throw RunFileError(fmt::format("{}: its config can't be read: {}", record.file.string(), error.what()));
  }
}

// (largest - smallest) / last value of H/W, over the last tenth of the frames up to `last`, at least two
// frames.
double settling_of(const RunRecord& record, std::int64_t last, const RunStrip& strip) {
  if (last == 0) return std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::infinity(), high = -low, value = 0;
  for (std::int64_t frame = last - std::max<std::int64_t>(1, last / 10); frame <= last; ++frame) {
    value = strip.meter.height_over_width(as_rows(read_positions(record.file, frame)),
                                          strip.options.clamp_offset);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return (high - low) / std::abs(value);
}

Json profile_json(const std::vector<ProfileRow>& profile) {
  Json rows = Json::array();
  for (const ProfileRow& row : profile)
    rows.push_back({{"s", row.s},
                    {"angle", row.angle},
                    {"curvature", row.curvature},
                    {"moment", row.moment},
                    {"fitted", row.fitted}});
  return rows;
}

std::string profile_text(const std::vector<ProfileRow>& profile) {
  Table table({"s (m)", "angle (degrees)", "curvature (1/m)", "moment (N)", "fitted"});
  for (const ProfileRow& row : profile)
    table.add_row({format_number(row.s), format_number(row.angle * 180 / std::numbers::pi),
                   format_number(row.curvature), format_number(row.moment), row.fitted ? "yes" : "no"});
  return table.text();
}

struct StiffnessCommand : Command {
  RunArgument asked{*this};
  StripSettings strip_settings;
  int asked_frame = -1;  // negative: from the end
  bool profile = false;

  StiffnessCommand() {
    add(strip_settings.clamp_offset, "--clamp-offset",
        "How far behind the clamp's edge the strip begins to bend, in m (default: a quarter of the reach "
        "of the bending constraints along the strip: h/2 for hinges on rows h apart, t h/4 for springs "
        "of ring t; 0 with physical stiffness)",
        not_negative);
    add(strip_settings.exclude, "--exclude",
        "Length at the clamp and at the free end that the fit of moment m to curvature κ leaves out, in "
        "m (default: the reach of the bending constraints)",
        not_negative);
    add(asked_frame, "--frame", "Which frame to measure; negative numbers count from the end");
    add(profile, "--profile", "Also print angle, curvature and moment along the strip");
    add(json, "--json", "Print one JSON object");
  }

  int run() override {
    const RunRecord record = asked.found();
    const std::int64_t frame = frame_of(record, asked_frame);
    const Positions positions = as_rows(read_positions(record.file, frame));
    const double time = read_metric(record.file, "time").at(static_cast<std::size_t>(frame));
    const RunStrip strip = strip_in(record.file, config_of(record), strip_settings);
    const StripStiffness stiffness = strip.meter.measure(positions, strip.options);
    const std::vector<Row> rows = rows_of(stiffness, strip.options, settling_of(record, frame, strip));
    if (json) {
      Json result = {{"id", record.id},
                     {"name", record.name},
                     {"file", record.file.string()},
                     {"frame", frame},
                     {"time", time}};
      for (const Row& row : rows) result[row.name] = row.value;
      result["fit_samples"] = stiffness.fit.samples;
      if (profile) result["profile"] = profile_json(stiffness.profile);
      print_text("{}\n", json_text(result));
      return exit_ok;
    }
    print_text("{}\n{}  {}  frame {} at {:.6g} s\n\n", record.file.string(), record.id, record.name, frame,
               time);
    Table table({"", "value", "unit", "what it is"});
    for (const Row& row : rows) table.add_row({row.name, format_number(row.value), row.unit, row.meaning});
    print_text("{}", table.text());
    if (profile) print_text("\n{}", profile_text(stiffness.profile));
    return exit_ok;
  }
};

}  // namespace

extern const CommandKind stiffness_command{"stiffness", "Measure how stiff the cantilever strip of a run is",
                                           "bendlab stiffness results/strip", make<StiffnessCommand>};

}  // namespace bendlab
