// runtime/gltf/import/textures.cpp: glTF's textures, samplers and images as names that shaders look
// up.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "runtime/description/findings.h"
#include "runtime/description/texture_name.h"
#include "runtime/gltf/import/import_p.h"

namespace kinora {

namespace {

TextureWrap wrap_of(int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return TextureWrap::Clamp;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return TextureWrap::Mirror;
    }
    return TextureWrap::Wrap;
}

bool is_one_of(int filter, std::initializer_list<int> filters) {
    return std::find(filters.begin(), filters.end(), filter) != filters.end();
}

double number(const tinygltf::Value& object, const char* name, double otherwise) {
    if (!object.Has(name) || !object.Get(name).IsNumber()) return otherwise;
    double value = object.Get(name).GetNumberAsDouble();
    return std::isfinite(value) ? value : otherwise;
}

double element(const tinygltf::Value& object, const char* name, int index, double otherwise) {
    if (!object.Has(name) || !object.Get(name).IsArray()) return otherwise;
    const tinygltf::Value& array = object.Get(name);
    if (size_t(index) >= array.ArrayLen() || !array.Get(index).IsNumber()) return otherwise;
    double value = array.Get(index).GetNumberAsDouble();
    return std::isfinite(value) ? value : otherwise;
}

}  // namespace

// The file of an image; an image inside the scene's file becomes a MemoryFile.
std::string GltfImport::image_path(int image, const std::string& pointer) {
    if (!exists(image, model_.images.size(), "image", pointer)) return "";
    auto [place, is_new] = images_.try_emplace(image);
    if (!is_new) return place->second;
    tinygltf::Image& from = model_.images[size_t(image)];
    std::string own = fmt::format("/images/{}", image);
    if (from.bufferView < 0 && from.image.empty()) {
        std::string path = gltf_path(file_, from.uri);
        if (!may_read_gltf(file_, options_, path)) {
            report(Code::GLTF_FILE, own + "/uri", path, "it lies outside the scene's folder");
            path.clear();
        }
        return place->second = path;
    }
    std::vector<uint8_t> bytes = std::move(from.image);
    if (from.bufferView >= 0) {
        const tinygltf::BufferView& view = model_.bufferViews[size_t(from.bufferView)];
        const std::vector<unsigned char>& data = model_.buffers[size_t(view.buffer)].data;
        if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset ||
            !charge(view.byteLength, own)) {
            report(Code::GLTF_VALUE, own, "the image reaches past the end of its buffer");
            return "";
        }
        auto begin = data.begin() + ptrdiff_t(view.byteOffset);
        bytes.assign(begin, begin + ptrdiff_t(view.byteLength));
    }
    auto memory = std::make_shared<MemoryFile>(file_.path + "#" + own, std::move(bytes));
    place->second = memory->name();
    out_.memory_files.push_back(std::move(memory));
    return place->second;
}

std::string GltfImport::texture_string(int texture, bool data, const std::string& pointer) {
    if (!exists(texture, model_.textures.size(), "texture", pointer)) return "";
    const tinygltf::Texture& from = model_.textures[size_t(texture)];
    std::string own = fmt::format("/textures/{}", texture);
    if (from.source < 0) {
        report(Code::GLTF_VALUE, own, "the texture names no image that can be read");
        return "";
    }
    TextureName name;
    name.path = image_path(from.source, own + "/source");
    if (name.path.empty()) return "";
    name.data = data;
    if (from.sampler >= 0 &&
        exists(from.sampler, model_.samplers.size(), "sampler", own + "/sampler")) {
        const tinygltf::Sampler& sampler = model_.samplers[size_t(from.sampler)];
        name.wrap_s = wrap_of(sampler.wrapS);
        name.wrap_t = wrap_of(sampler.wrapT);
        name.nearest_magnified = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        name.nearest_minified =
            is_one_of(sampler.minFilter, {TINYGLTF_TEXTURE_FILTER_NEAREST,
                                          TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST,
                                          TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR});
        if (is_one_of(sampler.minFilter,
                      {TINYGLTF_TEXTURE_FILTER_NEAREST, TINYGLTF_TEXTURE_FILTER_LINEAR}))
            name.mip = TextureMip::None;
        if (is_one_of(sampler.minFilter, {TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST,
                                          TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST}))
            name.mip = TextureMip::Nearest;
    }
    return texture_name_string(name);
}

// X_map and what goes with it (assets/shaders/gltf_pbr.sl).
void GltfImport::set_map(ShaderUse& use, const std::string& name, const Map& map, bool data,
                         const std::string& pointer) {
    if (map.index < 0) return;
    std::string text = texture_string(map.index, data, pointer + "/index");
    if (text.empty()) return;
    int set = map.set;
    auto found = map.extensions.find("KHR_texture_transform");
    if (found != map.extensions.end() && found->second.IsObject()) {
        // uv' = offset + R(rotation) (scale uv), v and angle downwards and counter-clockwise as the
        // extension's matrices have it; with t = 1 - v, row by row of (s, t, 1).
        const tinygltf::Value& transform = found->second;
        double ox = element(transform, "offset", 0, 0), oy = element(transform, "offset", 1, 0);
        double sx = element(transform, "scale", 0, 1), sy = element(transform, "scale", 1, 1);
        double angle = number(transform, "rotation", 0);
        double c = std::cos(angle), s = std::sin(angle);
        double u_u = c * sx, u_v = s * sy, v_u = -s * sx, v_v = c * sy;
        const double rows[6] = {u_u, -u_v, ox + u_v, -v_u, v_v, 1 - oy - v_v};
        constexpr const char* kNames[] = {"_ss", "_st", "_so", "_ts", "_tt", "_to"};
        for (size_t k = 0; k < 6; ++k)
            set_number(use, (name + kNames[k]).c_str(), std::span(&rows[k], 1));
        if (transform.Has("texCoord")) set = int(number(transform, "texCoord", set));
    }
    ParamSource source;
    source.name = name + "_map";
    source.strings = {text};
    source.texcoord = fmt::format("TEXCOORD_{}", set);
    source.where = gltf_location(file_, pointer);
    use.params.push_back(std::move(source));
}

}  // namespace kinora
