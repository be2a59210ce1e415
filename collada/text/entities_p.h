// collada/text/entities_p.h: references of a text: to entities that its document type would have to
// explain, and ampersands that begin no reference.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "collada/text/byte_range.h"

namespace kinora::collada {

// The name in the first reference to an entity other than the five of XML, of UTF-8 text that has a
// document type; nothing for a text without one, where the parser knows that there are no others.
// Declarations alone are no use; a default of <!ATTLIST> that names an entity is. No entity is ever
// expanded: who parses, parses up to here.
std::optional<ByteRange> find_entity_use(std::string_view text);

// Each '&' of UTF-8 text that begins no reference XML knows: "Salt & Pepper", "a&b", and "&nbsp;"
// where no document type could declare it.
std::vector<uint32_t> bare_ampersands(std::string_view text);
// The text with "&amp;" in the place of the '&' at these bytes, which ascend.
std::string escape_ampersands(std::string_view text, const std::vector<uint32_t>& at);

}  // namespace kinora::collada
