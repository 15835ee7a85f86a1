// Switches floating-point traps on before main(), for this thread and those that it starts: an invalid
// operation (0/0, inf - inf, a comparison of a NaN) or a division by zero ends the program where it happens,
// not where its NaN is noticed. Overflow and underflow do not: a diverging cloth overflows, and is to be
// reported as such. (What single precision makes of the infinities within that step is invalid, though, and
// traps.)
#include <fenv.h>

namespace {
[[maybe_unused]] const int before = feenableexcept(FE_INVALID | FE_DIVBYZERO);
}
