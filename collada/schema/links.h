// collada/schema/links.h: which values of a document are links.
#pragma once

#include <string_view>
#include <vector>

#include "collada/document/document.h"

namespace kinora::collada {

// A value that is a URI by the element table: an attribute's, or (null) the element's text.
struct UriValue {
    const Element* element;
    const Attribute* attribute;
    std::string_view value;
};

// All of them but xml:base, in document order. Of elements that the table does not know url, source
// and target are taken for URIs.
std::vector<UriValue> uri_values(const Document& document);

}  // namespace kinora::collada
