// runtime/scene/ri/bytestream/unzip.cpp: streams that gzip packed, by libdeflate.
#include "runtime/scene/ri/bytestream/unzip_p.h"

#include <fmt/core.h>
#include <libdeflate.h>

#include <algorithm>
#include <memory>

#include "runtime/base/shared_library.h"

namespace kinora::ri {
namespace {

struct Inflater : SharedLibrary {
    Inflater() : SharedLibrary(KINORA_DEFLATE_LIBRARY, "packed RIB is read", "libdeflate0") {}

    KINORA_FUNCTION(libdeflate_alloc_decompressor);
    KINORA_FUNCTION(libdeflate_free_decompressor);
    KINORA_FUNCTION(libdeflate_gzip_decompress_ex);
};

constexpr uint64_t kMostForOne = 1032;  // what deflate makes of a byte at most
constexpr size_t kLeast = 18;           // bytes of an empty member
constexpr int kMostLayers = 4;

// One packed stream: members, one after another.
class Members {
  public:
    Members(std::string_view packed, uint64_t limit) : rest_(packed), limit_(limit) {
        const Inflater& library = opened<Inflater>();
        if (library.error().empty())
            inflater_ = {library.libdeflate_alloc_decompressor(),
                         library.libdeflate_free_decompressor};
        else
            unpacked_.error = library.error();
    }

    Unzipped take_all() {
        while (unpacked_.error.empty() && is_zipped(rest_)) next();
        return std::move(unpacked_);
    }
    std::string take_beginning() {
        room_ = size_t(limit_);
        if (unpacked_.error.empty()) inflate();
        return std::move(unpacked_.bytes);
    }

  private:
    libdeflate_result inflate();
    void next();
    void keep_whole_part();

    std::string_view rest_;
    uint64_t limit_;
    std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater_{nullptr,
                                                                                           nullptr};
    size_t room_ = 0, before_ = 0;
    size_t read_ = 0, written_ = 0;
    Unzipped unpacked_;
};

// The next member into `room_` bytes behind those of the members before it.
libdeflate_result Members::inflate() {
    unpacked_.bytes.resize(before_ + room_);
    return opened<Inflater>().libdeflate_gzip_decompress_ex(
        inflater_.get(), rest_.data(), rest_.size(), unpacked_.bytes.data() + before_, room_,
        &read_, &written_);
}

void Members::next() {
    before_ = unpacked_.bytes.size();
    uint64_t most = std::min(limit_ - before_, kMostForOne * rest_.size());
    // A member ends with its size, which another one behind it hides.
    uint32_t told = 0;
    for (size_t i = 0; i < 4 && rest_.size() >= kLeast; ++i)
        told = told << 8 | uint8_t(rest_[rest_.size() - 1 - i]);
    room_ = size_t(std::min<uint64_t>(std::max<uint64_t>(told, 4 * rest_.size()), most));
    libdeflate_result result = inflate();
    while (result == LIBDEFLATE_INSUFFICIENT_SPACE && room_ < most) {
        room_ = size_t(std::min<uint64_t>(4 * uint64_t(room_), most));
        result = inflate();
    }
    if (result == LIBDEFLATE_SUCCESS) {
        unpacked_.bytes.resize(before_ + written_);
        rest_.remove_prefix(read_);
    } else if (result == LIBDEFLATE_INSUFFICIENT_SPACE) {
        unpacked_.bytes.resize(before_ + room_);
        unpacked_.error = fmt::format("it unpacks to more than {} bytes", before_ + room_);
    } else {
        keep_whole_part();
        unpacked_.error = "it is damaged or cut off";
    }
}

// libdeflate does not tell how far it came, but where it fails for want of room it came as far.
void Members::keep_whole_part() {
    size_t good = 0, bad = room_;
    while (good + 1 < bad) {
        room_ = good + (bad - good) / 2;
        (inflate() == LIBDEFLATE_INSUFFICIENT_SPACE ? good : bad) = room_;
    }
    room_ = good;
    inflate();
    unpacked_.bytes.resize(before_ + good);
}

}  // namespace

bool is_zipped(std::string_view bytes) {
    return bytes.starts_with("\x1f\x8b");
}

Unzipped unzip(std::string bytes, const UnzipLimits& limits) {
    uint64_t limit =
        std::min(limits.bytes, std::max(limits.free_bytes, limits.ratio * bytes.size()));
    Unzipped unpacked{std::move(bytes), ""};
    for (int layer = 0; is_zipped(unpacked.bytes) && unpacked.error.empty(); ++layer) {
        if (layer == kMostLayers) {
            unpacked.error = fmt::format("it is packed more than {} times", kMostLayers);
            break;
        }
        unpacked = Members(unpacked.bytes, limit).take_all();
    }
    if (is_zipped(unpacked.bytes)) unpacked.bytes.clear();
    return unpacked;
}

std::string unzip_beginning(std::string_view bytes, size_t count) {
    std::string beginning(bytes.substr(0, count));
    for (int layer = 0; layer < kMostLayers && is_zipped(beginning); ++layer)
        beginning = Members(layer ? std::string_view(beginning) : bytes, count).take_beginning();
    return beginning;
}

}  // namespace kinora::ri
