// JSON for a message or a line of output.
#pragma once

#include <string>

namespace bendlab {

/// On one line. Bytes that are no UTF-8, as a file of others may have, become U+FFFD.
template <class Document>
std::string json_text(const Document& document) {
  return document.dump(-1, ' ', false, Document::error_handler_t::replace);
}

}  // namespace bendlab
