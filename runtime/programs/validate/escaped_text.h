// runtime/programs/validate/escaped_text.h: text as JSON, XML and URIs spell it.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// The text as UTF-8; bytes that are none become U+FFFD.
std::string valid_utf8(std::string_view text);

// With its quotes; always valid JSON.
std::string json_string(std::string_view text);

// A finite number in its shortest form; null for others.
std::string json_number(double number);

// For XML and HTML, in text and attributes; control characters become U+FFFD.
std::string xml_text(std::string_view text);

// A path as a relative or file: URI reference.
std::string uri_of_path(std::string_view path);

}  // namespace kinora
