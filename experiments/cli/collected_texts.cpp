#include "experiments/cli/collected_texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bendlab/scene/counted.hpp"

namespace bendlab {
namespace {

void collect(std::vector<CollectedText>& collected, const CampaignRun& run, const Warning& found) {
  auto same = std::ranges::find(collected, found.code, &CollectedText::kind);
  if (same == collected.end())
    same = collected.insert(same, {.kind = found.code, .place = {}, .message = {}});
  const bool first = same->runs++ == 0;
  if (first || found.severity > same->worst) {
    same->worst = found.severity, same->worst_text = found.measured;
    same->place = place_text(run), same->message = found.message;
  }
  if (first || found.severity < same->mildest)
    same->mildest = found.severity, same->mildest_text = found.measured;
}

// By how much a bound is broken: measured over limit; what is not finite is the worst.
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
  std::string others;
  if (text.runs > 1 && text.worst_text == text.mildest_text)
    others = fmt::format(" (and {}{}{})", counted(text.runs - 1, "more run"),
                         text.worst_text.empty() ? "" : ": ", text.worst_text);
  else if (text.runs > 1)
    others = fmt::format(" (the worst of {} runs: {} to {})", text.runs,
                         text.worst_text.empty() ? "not finite" : text.worst_text, text.mildest_text);
  return fmt::format("{}: {}{}", text.place, text.message, others);
}

}  // namespace bendlab
