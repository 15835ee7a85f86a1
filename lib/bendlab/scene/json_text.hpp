// JSON as text, for a message or a line of output.
#pragma once

#include <string>

namespace bendlab {

/// The document on one line. Bytes that are not UTF-8 (from a file with errors) become U+FFFD.
template <class Document>
std::string json_text(const Document& document) {
  return document.dump(-1, ' ', false, Document::error_handler_t::replace);
}

}  // namespace bendlab
