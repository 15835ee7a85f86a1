// `bendlab fabrics`: lists the fabrics of the table, and reads measurements into settings of a config.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "bendlab/scene/fabric_files.hpp"
#include "bendlab/scene/fabrics.hpp"
#include "experiments/cli/command.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

// Reads a file; an error names the file.
template <class Read>
auto read_named(const std::string& file, const Read& read) try {
  return read(file);
} catch (const std::exception& error) {
  throw UsageError(fmt::format("{}: {}", file, error.what()));
}

Json as_json(const Fabric& fabric) {
  Json json = {{"name", fabric.name},
               {"description", fabric.description},
               {"density", fabric.density},
               {"rigidity", {{"warp", fabric.warp}, {"weft", fabric.weft}}},
               {"source", fabric.source}};
  if (fabric.bias) json["rigidity"]["bias"] = *fabric.bias;
  const auto add = [&](const char* name, double value) {
    if (value > 0) json[name] = value;
  };
  add("hysteresis_hb", fabric.friction), add("softening_half_at", fabric.half_at);
  add("thickness", fabric.thickness), add("drape_percent", fabric.drape);
  return json;
}

int list_fabrics(bool json) {
  Json list = Json::array();
  Table table({"fabric", "g/m²", "B warp", "B weft", "B bias", "HB", "κ½", "drape", "what it is"});
  for (const Fabric& fabric : fabrics()) {
    list.push_back(as_json(fabric));
    const auto or_blank = [](double value, double scale) {
      return value > 0 ? fmt::format("{:.4g}", scale * value) : std::string();
    };
    table.add_row({std::string(fabric.name), fmt::format("{:.4g}", 1e3 * fabric.density),
                   fmt::format("{:.4g}", 1e6 * fabric.warp), fmt::format("{:.4g}", 1e6 * fabric.weft),
                   or_blank(fabric.bias.value_or(0), 1e6), or_blank(fabric.friction, 1e3),
                   or_blank(fabric.half_at, 1), or_blank(fabric.drape, 1), std::string(fabric.description)});
  }
  if (json) {
    print_text("{}\n", list.dump(2));
    return 0;
  }
  print_text(
      "{}\nB: rigidity of narrow strips in µN m. HB: internal friction in mN. κ½: curvature in 1/m at which "
      "the warp's moment is half of B κ. drape: Cusick's coefficient in %.\nTo use a fabric, write "
      "\"material\": {{\"fabric\": \"cotton_broad\"}} in a config. --json prints the sources.\n",
      table.text());
  return 0;
}

// A rigidity far from those of all fabrics is usually in another unit.
void warn_of_units(const Json& rigidity) {
  constexpr double far = 10;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Fabric& fabric : fabrics()) {
    least = std::min({least, fabric.warp, fabric.weft});
    most = std::max({most, fabric.warp, fabric.weft});
  }
  for (const auto& [direction, value] : rigidity.items())
    if (const double b = value.get<double>(); b < least / far || b > most * far)
      print_text(
          stderr,
          "bendlab: warning: {} has a rigidity of {:.2g} N m, but the fabrics that we know have {:.2g} to "
          "{:.2g} N m. Are the units of the measurement those of --help?\n",
          direction, b, least, most);
}

struct FabricsCommand : Command {
  std::string kes_warp, kes_weft, astm, arcsim;  // files with measurements
  std::optional<double> mass;                    // g/m²

  FabricsCommand() {
    add(kes_warp, "--kes-warp",
        "Curve of KES-FB2 along the warp: curvature in 1/cm and moment in gf cm/cm, two columns");
    add(kes_weft, "--kes-weft", "Curve of KES-FB2 along the weft");
    add(astm, "--astm",
        "Overhangs of ASTM D1388 at 41.5 degrees: warp, weft or bias, and the overhang in mm");
    add(arcsim, "--arcsim", "Material file of ARCSim (JSON)");
    add(mass, "--mass", "Mass per area in g/m²", positive);
    add(json, "--json", "Print the list as JSON, with the sources");
  }
  int run() override;
};

Json rigidity_of_kes(const FabricsCommand& arguments) {
  Json settings = {{"bending", {{"rigidity", Json::object()}}}};
  double friction = 0;
  std::vector<std::string> of_direction;
  for (const auto& [direction, file] :
       {std::pair{"warp", arguments.kes_warp}, {"weft", arguments.kes_weft}}) {
    const BendingMeasurement measured = read_named(file, kes_bending);
    settings["bending"]["rigidity"][direction] = measured.rigidity;
    friction += measured.friction / 2;
    of_direction.push_back(fmt::format("{:.3g} N along the {}", measured.friction, direction));
  }
  settings["bending"]["hysteresis"] = {{"hb", friction}};
  print_text(stderr, "hb is the mean of the measured HB, {}: a sheet has one number for both directions\n",
             fmt::join(of_direction, " and "));
  return settings;
}

Json rigidity_of_astm(const FabricsCommand& arguments) {
  if (!arguments.mass) throw UsageError("--astm needs the mass per area: --mass in g/m²");
  Json settings = {{"bending", {{"rigidity", Json::object()}}}};
  for (const BendingLengths& lengths : read_named(arguments.astm, astm_bending_lengths)) {
    const double rigidity =
        *arguments.mass * 1e-3 * 9.80665 * lengths.length * lengths.length * lengths.length;
    settings["bending"]["rigidity"][lengths.direction] = rigidity;
    if (lengths.specimens == 1)
      print_text(stderr, "{}: bending length {:.4g} mm from one specimen, rigidity {:.4g} N m\n",
                 lengths.direction, 1e3 * lengths.length, rigidity);
    else
      print_text(stderr,
                 "{}: bending length {:.4g} ± {:.2g} mm from {} specimens, rigidity {:.4g} N m ± {:.1f} %\n",
                 lengths.direction, 1e3 * lengths.length, 1e3 * lengths.uncertainty, lengths.specimens,
                 rigidity, 300 * lengths.uncertainty / lengths.length);
  }
  return settings;
}

int FabricsCommand::run() {
  const bool kes = !kes_warp.empty() || !kes_weft.empty();
  if (kes + !astm.empty() + !arcsim.empty() > 1)
    throw UsageError("choose one of --kes-warp with --kes-weft, --astm and --arcsim");
  if (!kes && astm.empty() && arcsim.empty()) return list_fabrics(json);
  if (kes && (kes_warp.empty() || kes_weft.empty()))
    throw UsageError("KES measures both directions: give --kes-warp and --kes-weft");
  Json settings = kes            ? rigidity_of_kes(*this)
                  : astm.empty() ? read_named(arcsim, arcsim_settings)
                                 : rigidity_of_astm(*this);
  if (mass) settings["material"]["density"] = *mass * 1e-3;
  warn_of_units(settings["bending"]["rigidity"]);
  print_text("{}\n", settings.dump(2));
  return exit_ok;
}

}  // namespace

extern const CommandKind fabrics_command{
    "fabrics", "List fabrics with measured numbers, or read measurements into the settings of a config",
    "bendlab fabrics --kes-warp warp.csv --kes-weft weft.csv --mass 124", make<FabricsCommand>};

}  // namespace bendlab
