// The commands that print the tables of which configs consist.
#include "experiments/cli/command.hpp"
#include "experiments/config/schema.hpp"
#include "experiments/measures/metrics.hpp"
#include "experiments/run/errors.hpp"
#include "experiments/terminal/printable.hpp"

namespace bendlab {
namespace {

template <std::string (*text)(), Json (*as_json)()>
struct DocumentationCommand : Command {
  DocumentationCommand() { add(json, "--json", "Print JSON"); }
  int run() override {
    print_text("{}\n", json ? as_json().dump(2) : text());
    return exit_ok;
  }
};

}  // namespace

extern const CommandKind models_command{"models", "List the bending models: settings, defaults, sources",
                                        "bendlab models --json",
                                        make<DocumentationCommand<models_text, models_json>>};
extern const CommandKind effects_command{"effects", "List the effects: settings, defaults, sources",
                                         "bendlab effects",
                                         make<DocumentationCommand<effects_text, effects_json>>};
extern const CommandKind measures_command{
    "measures", "List the measures: their metrics, units, meanings and cost", "bendlab measures",
    make<DocumentationCommand<measures_text, measures_json>>};
extern const CommandKind methods_command{"methods", "List the solver methods: settings, defaults, sources",
                                         "bendlab methods",
                                         make<DocumentationCommand<methods_text, methods_json>>};
extern const CommandKind schema_command{
    "schema", "List the settings of a config: units, defaults, ranges, meanings",
    "bendlab schema --json > schema.json", make<DocumentationCommand<schema_text, schema_json>>};

}  // namespace bendlab
