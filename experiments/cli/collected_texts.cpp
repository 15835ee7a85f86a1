#include "experiments/cli/collected_texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bendlab/scene/counted.hpp"

namespace bendlab {
namespace {

void collect(std::vector<CollectedText>& collected, const CampaignRun& run, const Warning& warning) {
  auto same = std::ranges::find(collected, warning.code, &CollectedText::kind);
  if (same == collected.end())
    same = collected.insert(same, {.kind = warning.code, .place = {}, .message = {}});
  const bool first = same->runs++ == 0;
  if (first || warning.severity > same->worst) {
    same->worst = warning.severity, same->worst_text = warning.measured;
    same->place = place_text(run), same->message = warning.message;
  }
  if (first || warning.severity < same->mildest)
    same->mildest = warning.severity, same->mildest_text = warning.measured;
}

// A broken bound as a warning. The severity is measured value / limit (infinite if the value is not finite).
Warning of_bound(const BrokenBound& broken) {
  Warning text{.code = std::string(name_of(broken.bound)), .message = text_of(broken)};
  text.severity = broken.measured / broken.limit;
  if (!std::isfinite(text.severity)) text.severity = std::numeric_limits<double>::infinity();
  if (std::isfinite(broken.measured)) {
    const std::string_view unit = unit_of(broken.bound);
    text.measured =
        fmt::format("{:.3g}{}{}", broken.measured, unit == "1" ? "" : " ", unit == "1" ? "" : unit);
  }
  return text;
}

}  // namespace

std::vector<CollectedText> collected_warnings(std::span<const CampaignRun> runs) {
  std::vector<CollectedText> collected;
  for (const CampaignRun& run : runs)
    if (run.outcome)
      for (const Warning& warning : run.outcome->warnings) collect(collected, run, warning);
  return collected;
}

std::vector<CollectedText> collected_bounds(std::span<const CampaignRun> runs) {
  std::vector<CollectedText> collected;
  for (const CampaignRun& run : runs)
    if (run.outcome && run.outcome->broken) collect(collected, run, of_bound(*run.outcome->broken));
  return collected;
}

std::string text_of(const CollectedText& text) {
  std::string range;
  if (text.runs > 1 && text.worst_text == text.mildest_text)
    range = fmt::format(" (and {}{}{})", counted(text.runs - 1, "more run"),
                        text.worst_text.empty() ? "" : ": ", text.worst_text);
  else if (text.runs > 1)
    range = fmt::format(" (the worst of {} runs: {} to {})", text.runs,
                        text.worst_text.empty() ? "not finite" : text.worst_text, text.mildest_text);
  return fmt::format("{}: {}{}", text.place, text.message, range);
}

}  // namespace bendlab
