// The kinds of settings that a search begins with, and why others are left out.
#pragma once

#include <string>
#include <vector>

#include "experiments/advise/front.hpp"
#include "experiments/advise/question.hpp"

namespace bendlab {

struct LeftOut {
  std::string what, why;
};

/// Adds it, together with what has the same reason.
void leave_out(std::vector<LeftOut>& left_out, const std::string& what, const std::string& why);

struct Kinds {
  std::vector<Setting> coarsest;     ///< of each kind
  std::vector<std::string> methods;  ///< that the scene allows
  std::vector<std::string> hinges;   ///< the models made of hinges that may be chosen
  std::vector<LeftOut> left_out;
};

/// Every model in pbd; in the methods that minimise energies, where hinges of all kinds come to the same pose
/// in much the same time, the reference's model and the config's own, or those in `models`. Each has the
/// recommended variant, and the config's own model also the config's. `methods` are of advised_methods; both
/// may be empty: all. Throws ConfigError if nothing can be the cloth.
Kinds kinds_to_begin_with(const Question& question, const std::vector<std::string>& models,
                          const std::vector<std::string>& methods);

}  // namespace bendlab
