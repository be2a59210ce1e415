// collada/schema/schema.h: the element table as others need it: as an XSD, and as an order of
// children.
#pragma once

#include <string>
#include <vector>

#include "collada/document/document.h"

namespace kinora::collada {

// An XML Schema of the version (1.4.0 and 1.4.1 share one) written from the element table,
// profile_RSL included. It needs no other file: attributes of the xml: namespace on <COLLADA> and
// MathML are let through unseen.
std::string print_schema(Version version);

// check_elements (document.h) by the rules of a version that need not be the document's own.
void check_elements(const Document& document, Diagnostics& diag, Version version);

// The children of an element in the order its content model asks for; those that may alternate, and
// those the table does not know there, keep their order.
std::vector<const Element*> schema_order(const Document& document, const Element& parent);

}  // namespace kinora::collada
