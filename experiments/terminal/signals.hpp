// Ctrl-C and SIGTERM: the first one asks runs to finish their frame, the second one leaves at once.
#pragma once

#include <atomic>

namespace bendlab {

/// From here on SIGINT and SIGTERM are caught: the first sets stop_flag(), the second ends the process with
/// 128 + its number.
void catch_stop_signals();

/// Set by the first signal.
const std::atomic<bool>& stop_flag();

/// 128 + the number of the signal that set stop_flag(); 0 if none did.
int stop_exit_code();

}  // namespace bendlab
