// collada/document/edit.h: changes to the bytes of a document, for fixes and options that touch
// little.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "collada/document/document.h"

namespace kinora::collada {

// Puts `text` instead of `bytes`; begin == end inserts before that byte, an empty text erases.
struct Edit {
    ByteRange bytes;
    std::string text;
};

// The text with all edits made. They may come in any order; inserts at one byte keep the order
// given and stand before what replaces the bytes that follow. Each range lies in the text
// (checked). An edit that would overlap an earlier range is left out: of two fixes of the same
// bytes the one given first is made, and reading the result again finds what is left.
// `left_out`, if given, counts them.
std::string apply_edits(std::string_view original, std::vector<Edit> edits,
                        size_t* left_out = nullptr);

// UTF-8 as it is; bytes that are none are taken for Latin-1.
std::string utf8_text(std::string_view text);

// utf8_text of characters that XML 1.0 can hold (2.2, Char): a space stands for each other one. All
// that follows goes through it.
std::string xml_characters(std::string_view text);

// Text as it stands between tags: & < > and carriage returns escaped.
std::string escape_text(std::string_view text);

// Text as it stands between double quotes: as above, and quotes, tabs and line ends.
std::string escape_attribute(std::string_view value);

// name="value", escaped.
std::string attribute_text(std::string_view name, std::string_view value);

// A CDATA section with `code`, split where it holds the section's end mark. Carriage returns cannot
// stand in one (XML makes line feeds of them).
std::string cdata(std::string_view code);

// The prefix of an element's name as the file has it, with its colon: "c:" of <c:COLLADA>; or "".
std::string_view prefix_of(std::string_view original, const Element& element);

// Markup whose element names without a prefix have this one; comments and CDATA stay.
std::string prefixed(std::string_view markup, std::string_view prefix);

// A text that was read from another encoding, its XML declaration saying UTF-8.
std::string declared_utf8(std::string_view text);

// --- common edits of elements
// ---------------------------------------------------------------------

// Takes the element away with its end tag; with the white space before it up to the line end.
Edit erase_element(std::string_view original, const Element& element);

// Writes the attribute: in place of its value, or as the last one of the start tag.
Edit set_attribute(std::string_view original, const Element& element, std::string_view name,
                   std::string_view value);

// Puts `markup` before the end tag of the element; <a/> becomes <a>markup</a>.
Edit append_child(std::string_view original, const Element& element, std::string_view markup);

}  // namespace kinora::collada
