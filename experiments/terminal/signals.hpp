// Ctrl-C and SIGTERM: the first signal asks runs to finish their frame, the second ends the program at once.
#pragma once

#include <atomic>

namespace bendlab {

/// From now on SIGINT and SIGTERM are caught: the first sets stop_flag(), the second ends the process with
/// 128 + its number.
void catch_stop_signals();

/// Set by the first signal.
const std::atomic<bool>& stop_flag();

/// 128 + the number of the signal that set stop_flag(); 0 before any signal.
int stop_exit_code();

}  // namespace bendlab
