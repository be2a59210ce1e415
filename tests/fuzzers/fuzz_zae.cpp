// tests/fuzzers/fuzz_zae.cpp: any bytes as an archive: limits, no file outside its folder, the
// scene inside.
#include <filesystem>

#include "collada/document/open_scene.h"
#include "collada/extract/extract.h"
#include "collada/scene/scene.h"
#include "tests/collada/scene_promises.h"
#include "tests/fuzzers/fuzzer.h"

using namespace kinora;

namespace {

constexpr collada::ArchiveLimits kLimits{
    .members = 64, .unpacked_bytes = 1 << 20, .ratio = 200, .free_bytes = 1 << 18};

// Regular files and folders only, no more than may be; their bytes.
uint64_t unpacked_bytes(const std::string& folder) {
    uint64_t bytes = 0, files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_symlink()) fuzz::expect("no links");
        if (!entry.is_regular_file()) continue;
        bytes += entry.file_size();
        ++files;
    }
    if (files > kLimits.members) fuzz::expect("as many members as may be");
    if (bytes > kLimits.unpacked_bytes) fuzz::expect("as many bytes as may be");
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Diagnostics diag;
    auto file = collada::open_scene_bytes("fuzz.zae", fuzz::text_of(data, size), diag, kLimits);
    if (!file && !diag.has_errors()) fuzz::expect("no scene without an error");
    if (!file) return 0;
    if (!file->document.starts_with(file->folder)) fuzz::expect("the scene is of the archive");
    fuzz::MemoryBound bound(unpacked_bytes(file->folder));
    auto document = collada::read_document(file->document, diag);
    if (!document) return 0;
    auto scene = collada::extract(*document, diag, {.folder = file->folder});
    if (scene) fuzz::expect(collada::broken_promise(*scene));
    fuzz::expect(collada::broken_place(diag));
    return 0;
}
