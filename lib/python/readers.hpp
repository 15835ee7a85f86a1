// Counts who reads the registries of models, effects and measures without the GIL. Meanwhile no class may be
// added.
#pragma once

#include <atomic>
#include <stdexcept>

namespace bendlab {

/// A reader, from before it gives up the GIL until it has the GIL again.
class RegistryReader {
 public:
  RegistryReader() { ++count(); }
  ~RegistryReader() { --count(); }
  RegistryReader(const RegistryReader&) = delete;
  RegistryReader& operator=(const RegistryReader&) = delete;

  /// Throws std::runtime_error if there is a reader. The caller has to hold the GIL.
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
