// runtime/scene/ri/bytestream/zip.cpp: bytes to gzip, by libdeflate.
#include "runtime/scene/ri/bytestream/zip.h"

#include <libdeflate.h>

#include <memory>
#include <new>

#include "runtime/base/shared_library.h"

namespace kinora::ri {
namespace {

struct Deflater : SharedLibrary {
    Deflater() : SharedLibrary(KINORA_DEFLATE_LIBRARY, "packed RIB is written", "libdeflate0") {}

    KINORA_FUNCTION(libdeflate_alloc_compressor);
    KINORA_FUNCTION(libdeflate_free_compressor);
    KINORA_FUNCTION(libdeflate_gzip_compress_bound);
    KINORA_FUNCTION(libdeflate_gzip_compress);
};
constexpr int kLevel = 6;  // of 12, as gzip's own default

}  // namespace

std::string zip(std::string_view bytes, std::string& error) {
    const Deflater& library = opened<Deflater>();
    error = library.error();
    if (!error.empty()) return "";
    std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> deflater(
        library.libdeflate_alloc_compressor(kLevel), library.libdeflate_free_compressor);
    if (!deflater) throw std::bad_alloc();
    std::string packed(library.libdeflate_gzip_compress_bound(deflater.get(), bytes.size()), '\0');
    packed.resize(library.libdeflate_gzip_compress(deflater.get(), bytes.data(), bytes.size(),
                                                   packed.data(), packed.size()));
    return packed;
}

}  // namespace kinora::ri
