#include "experiments/advise/kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bendlab/bending/model.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/advise/ladder.hpp"

namespace bendlab {
namespace {

bool among(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

void erase_text(std::string& text, const std::string& part) {
  if (const std::size_t at = text.find(part); at != std::string::npos) text.erase(at, part.size());
}

// In the words of the config's rules, which say what would have to be written.
std::string reason(const ConfigProblem& problem, const Setting& kind) {
  std::string why = problem.pointer + " " + problem.message;
  erase_text(why, " of " + kind.model);
  erase_text(why, fmt::format(" (because /solver/method is {})", kind.variant.method));
  return why;
}

// Why the scene allows no setting of that method.
std::string refusal(const ConfigError& error, const Setting& kind) {
  std::string text = "not searched: ";
  bool membrane = false;
  for (const ConfigProblem& problem : error.problems()) {
    text += (text.ends_with(": ") ? "" : "; ") + reason(problem, kind);
    membrane |= problem.pointer.starts_with("/material/strain");
  }
  if (membrane)
    text += fmt::format(
        ". Errors at rest are against a membrane of {0} m/N: it is stated by --set "
        "/material/strain/stiffness=compliance --set /material/strain/compliance={0}",
        stiff_membrane);
  return text;
}

bool begins_with(const BendingModel& model, std::string_view method, const Question& question) {
  return method == advised_methods.front() || model.name == question.reference_model() ||
         model.name == question.scene().bending_model();
}

// Of a model and a method the recommended kind with either membrane, and of the config's own model also what
// the config has.
std::vector<Setting> kinds_of(const std::string& model, const std::string& method, const Question& question) {
  const Variant& own = question.own_variant();
  std::vector<Variant> variants = {question.recommended_variant(method, true),
                                   question.recommended_variant(method, false)};
  if (model == question.scene().bending_model()) variants.push_back(in_method(own, method, own.softened));
  std::vector<Setting> kinds;
  for (const Variant& variant : variants)
    if (std::ranges::find(kinds, variant, &Setting::variant) == kinds.end())
      kinds.push_back(coarsest({.model = model, .variant = variant}));
  return kinds;
}

bool can_be(const std::string& model, const std::string& method, const Question& question) try {
  question.run_with({.model = model, .variant = question.recommended_variant(method)}, Json::object());
  return true;
} catch (const ConfigError&) {
  return false;
}

}  // namespace

void leave_out(std::vector<LeftOut>& left_out, const std::string& what, const std::string& why) {
  const auto same = std::ranges::find(left_out, why, &LeftOut::why);
  if (same != left_out.end())
    same->what += ", " + what;
  else
    left_out.push_back({what, why});
}

Kinds kinds_to_begin_with(const Question& question, const std::vector<std::string>& models,
                          const std::vector<std::string>& methods) {
  Kinds found;
  std::optional<ConfigError> first;
  for (const std::string_view name : advised_methods) {
    const std::string method(name);
    if (!methods.empty() && !among(methods, method)) continue;
    const Setting probe{.model = question.reference_model(), .variant = question.recommended_variant(method)};
    try {
      question.run_with(probe, Json::object());
    } catch (const ConfigError& error) {
      leave_out(found.left_out, method, refusal(error, probe));
      if (!first) first = error;
      continue;
    }
    found.methods.push_back(method);
    for (const BendingModel* model : bending_models()) {
      const std::string model_name(model->name);
      if (models.empty() ? !begins_with(*model, method, question) : !among(models, model_name)) continue;
      for (const Setting& kind : kinds_of(model_name, method, question)) try {
          question.run_with(kind, Json::object());
          found.coarsest.push_back(kind);
        } catch (const ConfigError& error) {
          const bool usual = method == advised_methods.front();
          leave_out(found.left_out, usual ? model_name : fmt::format("{} in {}", model_name, method),
                    reason(error.problems().front(), kind));
          if (!first) first = error;
        }
    }
  }
  if (found.coarsest.empty() && first) throw *first;
  for (const BendingModel* model : bending_models())
    if (is_made_of_hinges(*model) && (models.empty() || among(models, model->name)) &&
        can_be(std::string(model->name), found.methods.front(), question))
      found.hinges.emplace_back(model->name);
  return found;
}

}  // namespace bendlab
