// runtime/scene/gltf/export/textures.cpp: texture names as glTF's images, samplers and textures.
#include "runtime/scene/gltf/export/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "runtime/base/files/temporary_file.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/description/memory_file.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/images/texture_image.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kMostBytes = uint64_t(1) << 31;  // of a picture's file

std::string read_bytes(const std::string& path) {
    return read_regular_file(path, kMostBytes).value_or("");
}

const char* mime_type(const std::string& bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    return nullptr;
}

uint8_t encoded_byte(float x) {  // IEC 61966-2-1
    x = std::clamp(std::isfinite(x) ? x : 0.0f, 0.0f, 1.0f);
    float y = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    return uint8_t(std::lround(255 * y));
}

// Other formats as PNG; what that cuts off is said in `loss`.
std::string as_png(const std::string& path, std::string& error, std::string& loss) {
    TextureImage image;
    error = read_texture_image(path, image);
    if (!error.empty()) return {};
    Image8 out{image.width, image.height, image.bytes};
    if (image.is_float()) {
        loss = "values beyond 8 bits";
        out.rgba.resize(image.floats.size());
        for (size_t i = 0; i < image.floats.size(); ++i)
            out.rgba[i] = i % 4 == 3 || image.encoded
                              ? uint8_t(std::lround(255 * std::clamp(image.floats[i], 0.0f, 1.0f)))
                              : encoded_byte(image.floats[i]);
    }
    const std::string temporary = temporary_name(fs::temp_directory_path() / "kinora.png");
    error = write_png(temporary, out, {});
    std::string bytes = error.empty() ? read_bytes(temporary) : "";
    std::error_code code;
    fs::remove(temporary, code);
    return bytes;
}

// glTF 2.0, sampler.
constexpr int kWraps[] = {10497, 33648, 33071, 33071};  // TextureWrap
// OpenGL's numbers, which glTF uses: NEAREST, LINEAR, then x_MIPMAP_NEAREST and x_MIPMAP_LINEAR.
constexpr int kNearest = 9728, kMipped = 9984;

int min_filter(const TextureName& look) {
    bool linear = !look.nearest && !look.nearest_minified;
    if (look.mip == TextureMip::None) return kNearest + linear;
    return kMipped + linear + 2 * (look.mip == TextureMip::Linear && !look.nearest);
}

}  // namespace

bool TextureWriter::has_file(const std::string& path) const {
    std::error_code code;
    return is_memory_file(path) || fs::is_regular_file(pictures_.find(path).path, code);
}

uint32_t TextureWriter::write_image(const std::string& path) {
    auto [found, fresh] = images_.try_emplace(path, kNone);
    if (!fresh) return found->second;
    AllowedPaths::Found file =
        is_memory_file(path) ? AllowedPaths::Found{path} : pictures_.find(path);
    std::string bytes, error, loss;
    if (file.outside) {
        losses_.lost(fmt::format("image '{}'", path), "it lies outside the scene's folder");
        return kNone;
    }
    bytes = read_bytes(FileToOpen(file.path).path());
    const char* type = mime_type(bytes);
    if (!type) {
        bytes = as_png(file.path, error, loss);
        type = "image/png";
    }
    if (bytes.empty()) {
        losses_.lost(fmt::format("image '{}'", path), error.empty() ? "it cannot be read" : error);
        return kNone;
    }
    if (!loss.empty()) losses_.lost(fmt::format("image '{}'", path), loss);
    document_.begin("images");
    Json result = {{"name", fs::path(path).filename().string()},
                   {"bufferView", buffer_.view(bytes.data(), bytes.size(), 0)},
                   {"mimeType", type}};
    return found->second = document_.add("images", std::move(result));
}

uint32_t TextureWriter::write(const std::string& name) {
    TextureName look = parse_texture_name(name);
    uint32_t source = write_image(look.path);
    if (source == kNone) return kNone;
    Json sampler = {{"magFilter", kNearest + !(look.nearest || look.nearest_magnified)},
                    {"minFilter", min_filter(look)},
                    {"wrapS", kWraps[size_t(look.wrap_s)]},
                    {"wrapT", kWraps[size_t(look.wrap_t)]}};
    std::string key = fmt::format("{} {}", source, text_of(sampler));
    auto [found, fresh] = textures_.try_emplace(key, uint32_t(textures_.size()));
    if (!fresh) return found->second;
    if (look.wrap_s == TextureWrap::Border || look.wrap_t == TextureWrap::Border)
        losses_.lost(fmt::format("image '{}'", look.path), "its border color (edges are repeated)");
    uint32_t index = document_.add("samplers", std::move(sampler));
    document_.add("textures", {{"sampler", index}, {"source", source}});
    return found->second;
}

bool fits_gltf_sampler(const TextureName& look) {
    return look.wrap_s != TextureWrap::Border && look.wrap_t != TextureWrap::Border &&
           look.turn == TextureName().turn && look.mip_bias == 0 && look.mip_max_level == 0;
}

}  // namespace kinora
