// runtime/base/text_encoding.h: files of shader text in another encoding than UTF-8.
#pragma once

#include <string>

namespace kinora {

// UTF-16 with a byte order mark, as some editors of Windows write it, becomes UTF-8; all else is
// left as it is. Halves of surrogate pairs and a last odd byte become U+FFFD.
std::string utf8_text(std::string bytes);

}  // namespace kinora
