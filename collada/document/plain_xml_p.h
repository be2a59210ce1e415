// collada/document/plain_xml_p.h: the fast way through documents of plain XML.
#pragma once

#include "collada/document/document_builder_p.h"

namespace kinora::collada {

// Reads elements, attributes, texts, CDATA sections, comments, references to characters and to the
// five named entities, as expat would report them. False for everything else, be it wrong or only
// rare (a DTD, a processing instruction, a name beyond ASCII, text beside child elements, too much
// of something): the builder is then of no use and expat reads the file from its beginning. So this
// reader judges nothing: what it accepts is well-formed, and what is wrong with the rest expat
// says. The byte behind the text must be readable and 0.
bool read_plain_xml(std::string_view text, DocumentBuilder& builder);

}  // namespace kinora::collada
