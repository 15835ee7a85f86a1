#include "tests/places.hpp"

#include "bendlab_places.hpp"

namespace bendlab::places {

const char *const source = BENDLAB_SOURCE_DIR, *const program = BENDLAB_PROGRAM,
                  *const bare_program = BENDLAB_BARE_PROGRAM, *const python = BENDLAB_PYTHON;

}  // namespace bendlab::places
