// Paths of the checkout and its programs. They have a file of their own: otherwise, after a checkout was
// moved, no test could be taken from the object cache.
#pragma once

namespace bendlab::places {

extern const char *const source, *const program, *const bare_program, *const python;

}  // namespace bendlab::places
