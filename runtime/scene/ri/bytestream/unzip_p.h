// runtime/scene/ri/bytestream/unzip_p.h: streams that gzip packed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kinora::ri {

bool is_zipped(std::string_view bytes);

struct UnzipLimits {
    uint64_t bytes = uint64_t(4) << 30;        // of a stream: places in it are 32 bits
    uint64_t ratio = 200;                      // bytes for one of the file, where
    uint64_t free_bytes = uint64_t(64) << 20;  // more than this is unpacked
};

struct Unzipped {
    std::string bytes;  // what could be unpacked
    std::string error;  // why that is not all
};
// As often as it was packed: twice by programs that pack a file which the renderer packed already.
Unzipped unzip(std::string bytes, const UnzipLimits& limits = {});
// Its first bytes, about as many as `count`; fewer where it is damaged.
std::string unzip_beginning(std::string_view bytes, size_t count);

}  // namespace kinora::ri
