// Where the checkout and its programs are. In a file of its own, because the object cache of a checkout that
// was moved would otherwise miss every test.
#pragma once

namespace bendlab::places {

extern const char *const source, *const program, *const bare_program, *const python;

}  // namespace bendlab::places
