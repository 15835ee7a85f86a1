// Switches floating-point traps on before main(), for this thread and the threads that it starts. An invalid
// operation (0/0, inf - inf, a comparison of a NaN) or a division by zero then ends the program at once, and
// not only where a NaN is noticed. Overflow and underflow do not trap, because a diverging cloth overflows,
// and the program has to report the divergence. (In single precision, later operations of the same step on
// infinities may be invalid and trap.)
#include <fenv.h>

namespace {
[[maybe_unused]] const int before = feenableexcept(FE_INVALID | FE_DIVBYZERO);
}
