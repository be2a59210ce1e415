// runtime/scene/gltf/import/textures.cpp: glTF's textures, samplers and images as names that
// shaders look up.
#include "runtime/scene/gltf/import/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/gltf/file/value.h"
#include "runtime/scene/gltf/import/values.h"

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

double element(const tinygltf::Value& object, const char* name, int index, double otherwise) {
    if (!object.Has(name) || !object.Get(name).IsArray()) return otherwise;
    const tinygltf::Value& array = object.Get(name);
    if (size_t(index) >= array.ArrayLen() || !array.Get(index).IsNumber()) return otherwise;
    double value = array.Get(index).GetNumberAsDouble();
    return std::isfinite(value) ? value : otherwise;
}

// uv' = offset + R(rotation) (scale uv), v and angle downwards and counter-clockwise as
// KHR_texture_transform's matrices have it; with t = 1 - v, row by row of (s, t, 1).
void transform_rows(const std::vector<double>& offset, double angle,
                    const std::vector<double>& scale, double* rows) {
    double c = std::cos(angle), s = std::sin(angle);
    double u_u = c * scale[0], u_v = s * scale[1], v_u = -s * scale[0], v_v = c * scale[1];
    std::ranges::copy(std::array{u_u, -u_v, offset[0] + u_v, -v_u, v_v, 1 - offset[1] - v_v}, rows);
}

void apply_sampler(const tinygltf::Sampler& sampler, TextureName& name) {
    name.wrap_s = wrap_of(sampler.wrapS);
    name.wrap_t = wrap_of(sampler.wrapT);
    name.nearest_magnified = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    name.nearest_minified =
        is_one_of(sampler.minFilter,
                  {TINYGLTF_TEXTURE_FILTER_NEAREST, TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST,
                   TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR});
    if (is_one_of(sampler.minFilter,
                  {TINYGLTF_TEXTURE_FILTER_NEAREST, TINYGLTF_TEXTURE_FILTER_LINEAR}))
        name.mip = TextureMip::None;
    if (is_one_of(sampler.minFilter, {TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST,
                                      TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST}))
        name.mip = TextureMip::Nearest;
}

}  // namespace

// The path of an image's file, there or not; "" where it may not be read.
std::string TextureImporter::find_picture(const std::string& uri, const std::string& pointer) {
    constexpr std::string_view kScheme = "file://";
    std::string path =
        gltf_path(file_, uri.starts_with(kScheme) ? uri.substr(kScheme.size()) : uri);
    FoundPicture found = search_.find(path, file_.directory, out_.pictures);
    switch (found.match) {
        case PictureMatch::Exact:
            return found.path;
        case PictureMatch::Case:
        case PictureMatch::Elsewhere:
            report_.add(Code::GLTF_FILE_FALLBACK, pointer, uri, found.path);
            return found.path;
        case PictureMatch::Outside:
            report_.add(Code::GLTF_FILE, pointer, path, "it lies outside the scene's folder");
            return "";
        case PictureMatch::Missing:
            return path;  // the image store says so
    }
    return "";
}

// The file of an image; an image inside the scene's file becomes a MemoryFile.
std::string TextureImporter::image_path(int image) {
    if (!has_index(image, file_.model.images.size())) return "";
    auto [known, is_new] = images_.try_emplace(image);
    if (!is_new) return known->second;
    tinygltf::Image& from = file_.model.images[size_t(image)];
    std::string own = fmt::format("/images/{}", image);
    if (from.bufferView < 0 && from.image.empty())
        return known->second = find_picture(from.uri, own + "/uri");
    std::vector<uint8_t> bytes = std::move(from.image);
    if (from.bufferView >= 0) {  // check_gltf_json() has looked at both
        const tinygltf::BufferView& view = file_.model.bufferViews[size_t(from.bufferView)];
        const std::vector<unsigned char>& data = file_.model.buffers[size_t(view.buffer)].data;
        if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset ||
            !budget_.charge(view.byteLength, own)) {
            report_.add(Code::GLTF_VALUE, own, "the image reaches past the end of its buffer");
            return "";
        }
        auto begin = data.begin() + ptrdiff_t(view.byteOffset);
        bytes.assign(begin, begin + ptrdiff_t(view.byteLength));
    }
    auto memory = std::make_shared<MemoryFile>(file_.path + "#" + own, std::move(bytes));
    known->second = memory->name();
    out_.memory_files.push_back(std::move(memory));
    return known->second;
}

std::string TextureImporter::texture_name(int texture, bool data) {
    if (!has_index(texture, file_.model.textures.size())) return "";
    const tinygltf::Texture& from = file_.model.textures[size_t(texture)];
    std::string own = fmt::format("/textures/{}", texture);
    if (from.source < 0) {
        report_.add(Code::GLTF_VALUE, own, "the texture names no image that can be read");
        return "";
    }
    TextureName name;
    name.path = image_path(from.source);
    if (name.path.empty()) return "";
    name.data = data;
    if (has_index(from.sampler, file_.model.samplers.size()))
        apply_sampler(file_.model.samplers[size_t(from.sampler)], name);
    return texture_name_string(name);
}

void TextureImporter::set_transform(ShaderUse& use, const std::string& name,
                                    const tinygltf::Value& transform, const std::string& pointer) {
    const std::vector<FileValue> values = {
        {pointer + "/offset",
         {element(transform, "offset", 0, 0), element(transform, "offset", 1, 0)}},
        {pointer + "/rotation", {number_member(transform, "rotation").value_or(0)}},
        {pointer + "/scale",
         {element(transform, "scale", 0, 1), element(transform, "scale", 1, 1)}}};
    double rows[6];
    transform_rows(values[0].rest, values[1].rest[0], values[2].rest, rows);
    std::vector<ValueSlot> slots;
    constexpr const char* kNames[] = {"_ss", "_st", "_so", "_ts", "_tt", "_to"};
    for (size_t k = 0; k < 6; ++k)
        slots.push_back(set_number(use, name + kNames[k], std::span(&rows[k], 1), out_.values));
    pointers_.follow(values, slots, [](std::span<const std::vector<double>> v, double* numbers) {
        transform_rows(v[0], v[1][0], v[2], numbers);
    });
}

// X_map and what goes with it (assets/shaders/gltf_pbr.sl).
void TextureImporter::set_map(ShaderUse& use, const std::string& name, const GltfTextureInfo& info,
                              bool data, const std::string& pointer) {
    if (info.index < 0) return;
    std::string text = texture_name(info.index, data);
    if (text.empty()) return;
    int set = info.set;
    auto found = info.extensions.find("KHR_texture_transform");
    if (found != info.extensions.end() && found->second.IsObject()) {
        set_transform(use, name, found->second, pointer + "/extensions/KHR_texture_transform");
        if (found->second.Has("texCoord"))
            set = int(number_member(found->second, "texCoord").value_or(set));
    }
    ParamSource source;
    source.name = name + "_map";
    source.strings = {text};
    source.texcoord = fmt::format("TEXCOORD_{}", set);
    source.where = report_.location(pointer);
    use.params.push_back(std::move(source));
}

}  // namespace kinora
