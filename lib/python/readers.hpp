// Counts the threads that read the registries of models, effects and measures without the GIL. While a thread
// reads, no class may be added.
#pragma once

#include <atomic>
#include <stdexcept>

namespace bendlab {

/// Counts its thread as a reader. Construct it before giving up the GIL, destroy it with the GIL.
class RegistryReader {
 public:
  RegistryReader() { ++count(); }
  ~RegistryReader() { --count(); }
  RegistryReader(const RegistryReader&) = delete;
  RegistryReader& operator=(const RegistryReader&) = delete;

  /// Throws std::runtime_error if there is a reader. The caller must hold the GIL.
  static void require_none() {
    if (count() > 0)
      throw std::runtime_error(
          "a class cannot be defined while run() computes or a scene is built: define the class earlier or "
          "later");
  }

 private:
  static std::atomic<int>& count() {
    static std::atomic<int> readers{0};
    return readers;
  }
};

}  // namespace bendlab
