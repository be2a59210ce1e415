// runtime/scene/gltf/file/file.h: a glTF file with its buffers in memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// tinygltf's implementation is compiled without its image decoder
// (runtime/scene/gltf/file/tinygltf.cpp).
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_source.h"

namespace kinora {

// The limits of what is read; hostile files say anything.
inline constexpr size_t kMaxGltfBytes = size_t(1)
                                        << 31;           // a file or buffer; tinygltf counts in int
inline constexpr size_t kMaxGltfDepth = 128;             // of JSON: tinygltf recurses into extras
inline constexpr size_t kMaxGltfContainers = 1'000'000;  // of JSON: as many nodes
inline constexpr size_t kMaxGltfFindings = 100;          // the rest is counted

struct GltfFile {
    std::string path;
    std::string directory;  // with its "/", or ""
    FileId file = kNoFile;
    std::string_view json;  // in Diagnostics::files
    tinygltf::Model model;  // image bytes of data URIs in Image::image as they were encoded
    size_t bytes = 0;       // read in all
    std::vector<std::string> files;  // read besides the JSON
};

// Reads the container (the source is a .gltf or .glb), its JSON and buffers. Files outside the
// scene's folder are read only in the folders of options.allow_external. Nothing where there is no
// model; what is wrong is in `diagnostics`.
std::optional<GltfFile> read_gltf_file(const SceneSource& source, const ImportOptions& options,
                                       Diagnostics& diagnostics);

// The path that a relative URI means, percent-decoded; "" for one that is no path.
std::string gltf_path(const GltfFile& file, const std::string& uri);
// Whether a file lies in the scene's folder or below, or in one that the user allows; links are
// followed.
bool may_read_gltf(const GltfFile& file, const ImportOptions& options, const std::string& path);

// The location of a JSON pointer's value in the file, or of the nearest around it.
Location gltf_location(const GltfFile& file, const std::string& pointer);

}  // namespace kinora
