// collada/text/encoding_p.h: from the bytes of a file to UTF-8 text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "collada/text/byte_range.h"
#include "runtime/base/uri/percent_encoding.h"

namespace kinora::collada {

struct DecodedText {
    std::string text;     // UTF-8 without BOM, if `error` is empty
    std::string error;    // "a gzip file": it is no text at all
    std::string recoded;  // "Latin-1": the text was transcoded although the file did not say so
};

// The declaration <?xml ...?> of a text, also where white space, comments or a byte order mark
// stand before it, which XML forbids (XML 1.0, 2.8); nothing for a text without one.
std::optional<ByteRange> xml_declaration(std::string_view text);

// Sees BOMs, UTF-16 without BOM, the XML declaration's encoding, and archives in disguise.
DecodedText decode_text(std::string bytes);

std::string utf8_from_latin1(std::string_view bytes);
// Surrogates and longer forms than needed pass.
bool valid_utf8(std::string_view text);

}  // namespace kinora::collada
