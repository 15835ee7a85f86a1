// Switches floating-point traps on before main(), for this thread and those that it starts. An invalid
// operation (0/0, inf - inf, a comparison of a NaN) or a division by zero then ends the program where it
// happens, not where its NaN is noticed. Overflow and underflow do not trap: a diverging cloth overflows, and
// the program has to report that. (In single precision, later operations on the infinities of that step may
// be invalid and trap.)
#include <fenv.h>

namespace {
[[maybe_unused]] const int before = feenableexcept(FE_INVALID | FE_DIVBYZERO);
}
