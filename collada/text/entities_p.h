// collada/text/entities_p.h: where a text uses an entity that its document type would have to
// explain.
#pragma once

#include <optional>
#include <string_view>

#include "collada/text/byte_range.h"

namespace kinora::collada {

// The name in the first reference to an entity other than the five of XML, of UTF-8 text that has a
// document type; nothing for a text without one, where the parser knows that there are no others.
// Declarations alone are no use; a default of <!ATTLIST> that names an entity is. No entity is ever
// expanded: who parses, parses up to here.
std::optional<ByteRange> find_entity_use(std::string_view text);

}  // namespace kinora::collada
