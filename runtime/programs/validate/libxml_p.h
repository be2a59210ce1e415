// runtime/programs/validate/libxml_p.h: libxml2, opened when a schema of another maker is first
// read.
#pragma once

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/uri.h>
#include <libxml/xmlschemas.h>

#include "runtime/base/shared_library.h"

namespace kinora {

// libxml2's functions, or why there are none. With the Unicode tables that it links it costs a
// start as much as our own code.
// xmlFree is a variable that holds a function.
struct Xml : SharedLibrary {
    Xml() : SharedLibrary(KINORA_XML_LIBRARY, "schemas of other makers are read", "libxml2") {}

    KINORA_FUNCTION(xmlAddChild);
    KINORA_FUNCTION(xmlDocSetRootElement);
    KINORA_FUNCTION(xmlFree);
    KINORA_FUNCTION(xmlFreeDoc);
    KINORA_FUNCTION(xmlInitParser);
    KINORA_FUNCTION(xmlNewDoc);
    KINORA_FUNCTION(xmlNewIOInputStream);
    KINORA_FUNCTION(xmlNewNode);
    KINORA_FUNCTION(xmlNewNs);
    KINORA_FUNCTION(xmlNewNsProp);
    KINORA_FUNCTION(xmlNewText);
    KINORA_FUNCTION(xmlParserInputBufferCreateMem);
    KINORA_FUNCTION(xmlSchemaFree);
    KINORA_FUNCTION(xmlSchemaFreeParserCtxt);
    KINORA_FUNCTION(xmlSchemaFreeValidCtxt);
    KINORA_FUNCTION(xmlSchemaNewParserCtxt);
    KINORA_FUNCTION(xmlSchemaNewValidCtxt);
    KINORA_FUNCTION(xmlSchemaParse);
    KINORA_FUNCTION(xmlSchemaSetParserStructuredErrors);
    KINORA_FUNCTION(xmlSchemaSetValidStructuredErrors);
    KINORA_FUNCTION(xmlSchemaValidateOneElement);
    KINORA_FUNCTION(xmlSearchNs);
    KINORA_FUNCTION(xmlSetExternalEntityLoader);
    KINORA_FUNCTION(xmlSetGenericErrorFunc);
    KINORA_FUNCTION(xmlSetNs);
    KINORA_FUNCTION(xmlStrdup);
    KINORA_FUNCTION(xmlURIUnescapeString);
};

inline const Xml& xml() {
    return opened<Xml>();
}

}  // namespace kinora
