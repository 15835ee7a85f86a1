#include "experiments/measures/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bendlab {

namespace measure {
#define BENDLAB_MEASURE(name) extern const Measure name;
#define BENDLAB_MEASURE_ON_REQUEST(name) extern const Measure name;
#include "experiments/measures/measures.def"
#undef BENDLAB_MEASURE
#undef BENDLAB_MEASURE_ON_REQUEST
}  // namespace measure

namespace {

std::size_t index_of(std::span<const Column> columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &Column::name);
  if (found == columns.end())
    throw std::logic_error("no measure of this run has the column " + std::string(name));
  return static_cast<std::size_t>(found - columns.begin());
}

}  // namespace

const std::vector<PrincipalStretches>& MeasuredFrame::stretches() const {
  if (!stretches_) stretches_ = meter_.measure(positions_);
  return *stretches_;
}

const StretchSummary& MeasuredFrame::stretch() const {
  if (!stretch_) stretch_ = meter_.summarise(stretches());
  return *stretch_;
}

double MeasuredFrame::value(std::string_view column) const {
  return values_[index_of(columns_, column)];
}

double FrameHistory::last(std::string_view column) const {
  return rows_.back()[index_of(columns_, column)];
}

double FrameHistory::largest(std::string_view column) const {
  const std::size_t index = index_of(columns_, column);
  double largest = 0;
  for (const std::vector<double>& row : rows_) largest = std::max(largest, row[index]);
  return largest;
}

double FrameHistory::last_second_median(std::string_view column) const {
  constexpr double rounding = 1e-9;  // s; a frame exactly one second before the end is not in it
  const std::size_t index = index_of(columns_, column);
  std::vector<double> values;
  for (std::size_t f = 0; f < times_.size(); ++f)
    if (times_[f] > times_.back() - 1 + rounding || times_.size() == 1) values.push_back(rows_[f][index]);
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    return std::numeric_limits<double>::quiet_NaN();
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle), values.end());
  if (values.size() % 2 == 1) return values[middle];
  return 0.5 * (values[middle] +
                *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle)));
}

std::span<const Measure* const> measures() {
  static constexpr std::array all = {
#define BENDLAB_MEASURE(name) &measure::name,
#define BENDLAB_MEASURE_ON_REQUEST(name) &measure::name,
#include "experiments/measures/measures.def"
#undef BENDLAB_MEASURE
#undef BENDLAB_MEASURE_ON_REQUEST
  };
  return all;
}

bool applies(const Measure& measure, const RunConfig& config, const Scene& scene) {
  if (measure.applies) return measure.applies(config, scene);
  const std::vector<std::string> asked = config.section("/output").texts("measures");
  return std::ranges::find(asked, measure.name) != asked.end();
}

bool always(const RunConfig&, const Scene&) {
  return true;
}

}  // namespace bendlab
