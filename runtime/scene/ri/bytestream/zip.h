// runtime/scene/ri/bytestream/zip.h: bytes as gzip packs them.
#pragma once

#include <string>
#include <string_view>

namespace kinora::ri {

// A member of a gzip file; members behind one another are a file, too. Empty, with a text in
// `error`, where the library is missing.
std::string zip(std::string_view bytes, std::string& error);

}  // namespace kinora::ri
