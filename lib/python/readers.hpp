// Who reads the registries of models, effects and measures without the GIL: meanwhile no class may be added.
#pragma once

#include <atomic>
#include <stdexcept>

namespace bendlab {

/// One reader, from before it gives the GIL up until it has it again.
class RegistryReader {
 public:
  RegistryReader() { ++count(); }
  ~RegistryReader() { --count(); }
  RegistryReader(const RegistryReader&) = delete;
  RegistryReader& operator=(const RegistryReader&) = delete;

  /// For holders of the GIL. Throws std::runtime_error.
  static void require_none() {
    if (count() > 0)
      throw std::runtime_error(
          "a class cannot be defined while run() computes or a scene is built: define it before, or "
          "afterwards");
  }

 private:
  static std::atomic<int>& count() {
    static std::atomic<int> readers{0};
    return readers;
  }
};

}  // namespace bendlab
