// runtime/scene/gltf/export/textures.h: texture names as glTF's images, samplers and textures.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "runtime/base/allowed_paths.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/gltf/document/buffer_writer.h"
#include "runtime/scene/gltf/document/loss_report.h"

namespace kinora {

class TextureWriter {
  public:
    TextureWriter(const AllowedPaths& pictures, GltfDocument& document, BufferWriter& buffer,
                  LossReport& losses)
        : pictures_(pictures), document_(document), buffer_(buffer), losses_(losses) {}

    // The texture of a name (texture_name.h); kNone where its image cannot be read.
    uint32_t write(const std::string& name);
    bool has_file(const std::string& path) const;

  private:
    uint32_t write_image(const std::string& path);

    const AllowedPaths& pictures_;
    GltfDocument& document_;
    BufferWriter& buffer_;
    LossReport& losses_;
    std::map<std::string, uint32_t> textures_;  // of a source and a sampler
    std::map<std::string, uint32_t> images_;    // of a path
};

// Whether a glTF sampler, "data" and "uv" say all of it.
bool fits_gltf_sampler(const TextureName& name);

}  // namespace kinora
