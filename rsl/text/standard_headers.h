// rsl/text/standard_headers.h: the headers that shaders include by custom (noises.h, patterns.h,
// ...): the texts of assets/shaders/include, compiled into the library. Files on the include path
// win.
#pragma once

#include <string_view>

namespace kinora::rsl {

// The text of a header by its file name without folders; empty when there is no such header.
std::string_view standard_header(std::string_view name);

// The header that defines a function or function-like macro of this name; "" when none does.
std::string_view header_that_defines(std::string_view function);

}  // namespace kinora::rsl
