// collada/links.h: which values of a document are links, and what files they mean.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "collada/document.h"

namespace kinora::collada {

// A value that is a URI by the element table: an attribute's, or (null) the element's text.
struct UriPlace {
    const Element* element;
    const Attribute* attribute;
    std::string_view value;
};

// All of them but xml:base, in document order. Of elements that the table does not know url, source
// and target are taken for URIs.
std::vector<UriPlace> uri_places(const Document& document);

// The path a URI means for a document, not checked to exist: schemes, %xx and backslashes undone,
// below xml:base where there is such a file.
std::string path_of_uri(const Document& document, std::string_view uri);

}  // namespace kinora::collada
