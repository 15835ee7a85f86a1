#include "experiments/run/run_record.hpp"

namespace bendlab {

std::string provenance_text(const RunRecord& run, const std::string& name, const std::string& absent) {
  const auto text = run.provenance.find(name);
  return text == run.provenance.end() ? absent : text->second;
}

Json provenance_json(const RunRecord& run, const std::string& name) {
  Json value = Json::parse(provenance_text(run, name, "null"), nullptr, false);
  return value.is_discarded() ? Json() : value;
}

}  // namespace bendlab
