// collada/document/write.h: the canonical writer: a document as text, and when two documents are
// equal.
//
// Canonical form: UTF-8 with an XML declaration and line feeds; one element a line, indented by two
// spaces; attributes in the order written, in double quotes; <a></a> as <a/>; numbers in the
// shortest form with the same double, one space between; text with markup characters on several
// lines in CDATA, other text escaped. Elements, attributes, text, foreign elements with their
// prefixes, comments and processing instructions are all kept; a document type is dropped.
// What reading cannot take apart without loss is copied byte for byte: elements that mix text with
// children or comments, and those under xml:space="preserve".
#pragma once

#include <string>

#include "collada/document/document.h"

namespace kinora::collada {

// Where the line ends are. In the others an element may be on a line with its neighbours.
enum class Layout : uint8_t {
    Indented,  // canonical
    Lines,     // without the indents
    Dense      // without line ends: for documents that have none
};

// `files` are those of the Diagnostics the document was read with. The document must be whole().
// write(read(write(x))) == write(x), and read(write(x)) equals x.
std::string write(const Document& document, const SourceFiles& files,
                  Layout layout = Layout::Indented);

// Whether a number list may be written anew inside this element: its text is numbers by its name,
// and it is not inside private data (<extra>, <technique profile>).
bool holds_numbers(const Element& element);

// Inside <extra> or <technique profile>: another maker's, whatever its name.
bool in_private_data(const Element& element);

// The same elements, attributes (in any order) and text. Number lists are compared as doubles, text
// that is only white space counts as none. `difference`, if given, says where they part.
bool equal(const Document& a, const Document& b, std::string* difference = nullptr);

// The shortest text with this value: an integer as written without '+' and leading zeros, else the
// shortest that gives the same double. What is no finite number stays as it is.
std::string shortest_number(std::string_view token);
std::string shortest_number(double value);

}  // namespace kinora::collada
