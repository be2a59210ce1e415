// runtime/programs/validate/libxml_p.h: libxml2, opened when a schema of another maker is first
// read.
#pragma once

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/uri.h>
#include <libxml/xmlschemas.h>

#include <string>

#include "runtime/base/shared_library.h"

namespace kinora {

// xmlFree is a variable that holds a function.
#define KINORA_XML_FUNCTIONS(X)                                                                    \
    X(xmlAddChild)                                                                                 \
    X(xmlDocSetRootElement) X(xmlFree) X(xmlFreeDoc) X(xmlInitParser) X(xmlNewDoc)                 \
        X(xmlNewIOInputStream) X(xmlNewNode) X(xmlNewNs) X(xmlNewNsProp) X(xmlNewText)             \
            X(xmlParserInputBufferCreateMem) X(xmlSchemaFree) X(xmlSchemaFreeParserCtxt)           \
                X(xmlSchemaFreeValidCtxt) X(xmlSchemaNewParserCtxt) X(xmlSchemaNewValidCtxt)       \
                    X(xmlSchemaParse) X(xmlSchemaSetParserStructuredErrors)                        \
                        X(xmlSchemaSetValidStructuredErrors) X(xmlSchemaValidateOneElement)        \
                            X(xmlSearchNs) X(xmlSetExternalEntityLoader) X(xmlSetGenericErrorFunc) \
                                X(xmlSetNs) X(xmlStrdup) X(xmlURIUnescapeString)

// libxml2's functions, or why there are none. With the Unicode tables that it links it costs a
// start as much as our own code.
struct Xml {
    KINORA_XML_FUNCTIONS(KINORA_LIBRARY_MEMBER)
    std::string error;

    Xml() {
        SharedLibrary library(KINORA_XML_LIBRARY, "schemas of other makers are read", "libxml2");
        KINORA_XML_FUNCTIONS(KINORA_LIBRARY_BIND)
        error = library.error();
    }
};

inline const Xml& xml() {
    static const Xml table;
    return table;
}

}  // namespace kinora
