// Which mutant is switched on. mutate.py writes calls of these functions into its copy of the sources, as
// README.md in this folder explains. The program itself never includes this file.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>

namespace bendlab_mutants {

inline constexpr std::size_t most = 4096;
inline unsigned char* notes = nullptr;  // a byte for each mutant: 1 after it was evaluated

/// The number of the mutant that BENDLAB_MUTANT names, or 0 if it names none. If BENDLAB_MUTANTS_REACHED
/// names a file, -1: no mutant is switched on, and the program and its child processes record in the file
/// which mutants they evaluate.
inline int chosen() {
  if (const char* const path = std::getenv("BENDLAB_MUTANTS_REACHED")) {
    const int file = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0 || ::ftruncate(file, most) != 0) std::abort();
    void* const bytes = ::mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (bytes == MAP_FAILED) std::abort();
    ::close(file);
    notes = static_cast<unsigned char*>(bytes);
    return -1;
  }
  const char* const number = std::getenv("BENDLAB_MUTANT");
  return number ? std::atoi(number) : 0;
}

inline const int active = chosen();

}  // namespace bendlab_mutants

/// Whether this mutant is switched on.
inline bool bendlab_mutant(int number) {
  if (bendlab_mutants::active >= 0) [[likely]]
    return bendlab_mutants::active == number;
  bendlab_mutants::notes[number] = 1;
  return false;
}

/// `value`, or -value if `flip`. (For an expression of Eigen, both have different types.)
template <class Value>
inline auto bendlab_flipped(bool flip, const Value& value) {
  if constexpr (requires { typename Value::PlainObject; }) {
    const typename Value::PlainObject plain = value;
    return typename Value::PlainObject(flip ? -plain : plain);
  } else {
    return flip ? -value : value;
  }
}
