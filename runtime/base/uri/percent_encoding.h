// runtime/base/uri/percent_encoding.h: URIs as text.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// %20 as a space (RFC 3986, 2.1); what is no such triple, and %00, stays.
std::string percent_decode(std::string_view text);

}  // namespace kinora
