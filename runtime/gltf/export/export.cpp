// runtime/gltf/export/export.cpp: the glTF file: buffer, accessors, cameras, chunks.
#include "runtime/gltf/export/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/description/findings.h"
#include "runtime/description/shader_library.h"
#include "runtime/gltf/export/export_p.h"

namespace kinora {

namespace {

template <class T>
constexpr int kComponentType = 0;
template <>
constexpr int kComponentType<float> = 5126;
template <>
constexpr int kComponentType<uint8_t> = 5121;
template <>
constexpr int kComponentType<uint16_t> = 5123;
template <>
constexpr int kComponentType<uint32_t> = 5125;

const char* type_name(uint32_t width) {
    static constexpr const char* kNames[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return width == 16 ? "MAT4" : kNames[width];
}

void append_word(std::string& bytes, uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes += char(word >> (8 * i) & 0xff);
}

uint32_t read_word(const std::string& bytes, size_t at) {
    uint32_t word = 0;
    for (size_t i = 0; i < 4; ++i) word |= uint32_t(uint8_t(bytes[at + i])) << (8 * i);
    return word;
}

constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;

}  // namespace

GltfExport::GltfExport(const SceneDescription& description, const GltfExportOptions& options,
                       Diagnostics& diagnostics)
    : description_(description), options_(options), diagnostics_(diagnostics) {}

uint32_t GltfExport::buffer_view(const void* data, size_t size, int target) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
    if (target) view["target"] = target;
    buffer_.append(static_cast<const char*>(data), size);
    json_["bufferViews"].push_back(view);
    return uint32_t(json_["bufferViews"].size() - 1);
}

template <class T>
uint32_t GltfExport::accessor(const std::vector<T>& numbers, uint32_t width, int target,
                              bool bounds) {
    uint32_t view = buffer_view(numbers.data(), numbers.size() * sizeof(T), target);
    Json result = {{"bufferView", view},
                   {"componentType", kComponentType<T>},
                   {"count", numbers.size() / width},
                   {"type", type_name(width)}};
    if (bounds) {
        Json low = Json::array(), high = Json::array();
        for (uint32_t c = 0; c < width; ++c) {
            T least = numbers[c], most = numbers[c];
            for (size_t i = c; i < numbers.size(); i += width) {
                least = std::min(least, numbers[i]);
                most = std::max(most, numbers[i]);
            }
            low.push_back(double(least));
            high.push_back(double(most));
        }
        result["min"] = low;
        result["max"] = high;
    }
    json_["accessors"].push_back(result);
    return uint32_t(json_["accessors"].size() - 1);
}
template uint32_t GltfExport::accessor(const std::vector<float>&, uint32_t, int, bool);
template uint32_t GltfExport::accessor(const std::vector<uint8_t>&, uint32_t, int, bool);
template uint32_t GltfExport::accessor(const std::vector<uint16_t>&, uint32_t, int, bool);
template uint32_t GltfExport::accessor(const std::vector<uint32_t>&, uint32_t, int, bool);

void GltfExport::lost(const std::string& what, const std::string& why, Location where) {
    if (told_.insert(what + why).second) diagnostics_.report(Code::CONVERT_LOST, where, what, why);
}

void GltfExport::in_extras(const std::string& what, const std::string& why, Location where) {
    diagnostics_.report(Code::CONVERT_EXTRAS, where, what, why);
}

bool GltfExport::is_animated(ValueSlot slot) const {
    for (uint32_t i = 0; slot.present() && i < slot.count; ++i)
        if (slot.offset + i < description_.animated.size() &&
            description_.animated[slot.offset + i])
            return true;
    return false;
}

std::span<const double> GltfExport::values(ValueSlot slot) const {
    if (!slot.present()) return {};
    return std::span(description_.values).subspan(slot.offset, slot.count);
}

void GltfExport::use_extension(const char* name) {
    if (std::find(extensions_.begin(), extensions_.end(), name) == extensions_.end())
        extensions_.push_back(name);
}

// glTF has the vertical field and the aspect: COLLADA's other pairs are turned into that.
Json GltfExport::camera(const CameraDefinition& c) {
    auto number = [&](ValueSlot slot) { return slot.present() ? values(slot)[0] : 0.0; };
    for (ValueSlot slot : {c.x, c.y, c.aspect, c.znear, c.zfar})
        if (is_animated(slot)) {
            lost(fmt::format("camera '{}'", c.id), "its animated optics", c.where);
            break;
        }
    double x = number(c.x), y = number(c.y), aspect = number(c.aspect);
    double far = number(c.zfar) * description_.meter, near = number(c.znear) * description_.meter;
    if (!(near > 0)) near = far > 0 ? 1e-4 * far : 1e-3 * bounds_radius_;
    if (!(far > near)) far = 0;
    Json optics;
    if (c.orthographic) {
        if (!(aspect > 0)) aspect = 1;
        if (!(x > 0)) x = y > 0 ? y * aspect : 1;
        if (!(y > 0)) y = x / aspect;
        optics = {{"xmag", x * description_.meter}, {"ymag", y * description_.meter}};
        if (!(far > 0)) far = near + 1e3 * bounds_radius_;
    } else {
        auto tangent = [](double degrees) { return std::tan(0.5 * radians(degrees)); };
        if (x > 0 && y > 0) aspect = tangent(x) / tangent(y);
        if (x > 0 && !(y > 0)) {
            if (!(aspect > 0)) {
                lost(fmt::format("camera '{}'", c.id),
                     "a horizontal field of view without an aspect ratio (1 is taken)", c.where);
                aspect = 1;
            }
            y = 2 * std::atan(tangent(x) / aspect) * 180 / kPi;
        }
        if (!(y > 0 && y < 180)) y = 37;
        optics["yfov"] = radians(y);
        if (aspect > 0) optics["aspectRatio"] = aspect;
    }
    optics["znear"] = near;
    if (far > 0) optics["zfar"] = far;
    const char* type = c.orthographic ? "orthographic" : "perspective";
    Json result = {{"type", type}, {type, optics}};
    if (!c.id.empty()) result["name"] = c.id;
    Json shaders = Json::object();
    if (!c.picture.atmosphere.empty()) shaders["atmosphere"] = rsl(c.picture.atmosphere);
    if (!c.picture.imagers.empty()) shaders["imagers"] = rsl(c.picture.imagers);
    if (!shaders.empty()) {
        result["extras"]["kinora_rsl"] = shaders;
        in_extras(fmt::format("camera '{}'", c.id), "its RSL shaders", c.where);
    }
    return result;
}

std::string GltfExport::finish() {
    Json scene = json_["scenes"][0];
    Json extras = Json::object();
    for (const Take& take : takes_) {
        if (take.channels.empty()) continue;
        Json animation = {{"channels", take.channels}, {"samplers", take.samplers}};
        if (!take.name.empty()) animation["name"] = take.name;
        json_["animations"].push_back(std::move(animation));
    }
    size_t ranges = 0;
    for (const ClipDefinition& clip : description_.clips) {
        bool is_take = std::any_of(takes_.begin(), takes_.end(), [&](const Take& take) {
            return take.animation == clip.animation.get() && !take.channels.empty();
        });
        if (is_take) continue;
        ++ranges;
        extras["kinora_clips"].push_back(
            {{"name", clip.name}, {"start", clip.start}, {"end", clip.end}});
    }
    if (description_.start_time) extras["kinora_start_time"] = *description_.start_time;
    if (description_.end_time) extras["kinora_end_time"] = *description_.end_time;
    if (description_.frame_rate) extras["kinora_frame_rate"] = *description_.frame_rate;
    if (ranges) in_extras("the scene", fmt::format("{} clips", ranges));
    Json shaders = Json::object();
    if (!description_.picture.atmosphere.empty())
        shaders["atmosphere"] = rsl(description_.picture.atmosphere);
    if (!description_.picture.imagers.empty())
        shaders["imagers"] = rsl(description_.picture.imagers);
    if (!shaders.empty()) {
        extras["kinora_rsl"] = shaders;
        in_extras("the scene", "its atmosphere and imagers");
    }
    if (!extras.empty()) json_["scenes"][0]["extras"] = extras;
    if (!extensions_.empty()) json_["extensionsUsed"] = extensions_;
    if (!buffer_.empty()) json_["buffers"].push_back({{"byteLength", buffer_.size()}});
    anim::TimeRange range = anim::time_range(description_.animation);
    if (range.begin < 0 && !description_.animation.channels.empty())
        lost("the animation", fmt::format("what moves before time 0 (from {} s)", range.begin));
    for (const anim::Sampler& sampler : description_.animation.samplers)
        if (sampler.pre != anim::Behaviour::Constant || sampler.post != anim::Behaviour::Constant) {
            lost("the animation", "what goes on beyond the range that is played (behaviours)");
            break;
        }
    if (sampled_paths_)
        diagnostics_.report(Code::CONVERT_SAMPLED, Location{}, sampled_paths_, worst_error_);
    std::string text = text_of(json_);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bin = buffer_;
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    std::string out;
    size_t size = 12 + 8 + text.size() + (bin.empty() ? 0 : 8 + bin.size());
    for (uint32_t word : {kMagic, 2u, uint32_t(size), uint32_t(text.size()), kJsonChunk})
        append_word(out, word);
    out += text;
    if (!bin.empty()) {
        append_word(out, uint32_t(bin.size()));
        append_word(out, kBinChunk);
        out += bin;
    }
    return out;
}

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string export_glb(const SceneDescription& description, const GltfExportOptions& options,
                       Diagnostics& diagnostics) {
    return GltfExport(description, options, diagnostics).glb();
}

GlbParts split_glb(const std::string& glb) {
    GlbParts parts;
    if (glb.size() < 20) return parts;
    size_t length = read_word(glb, 12);
    parts.json = glb.substr(20, length);
    if (glb.size() >= 28 + length) parts.buffer = glb.substr(28 + length);
    return parts;
}

const ParamSource* find_source(const ShaderUse& use, std::string_view name) {
    for (const ParamSource& source : use.params)
        if (source.name == name) return &source;
    return nullptr;
}

bool is_library_shader(const ShaderUse& use, std::string_view name) {
    if (!use.shader || use.shader->name != name) return false;
    Diagnostics quiet;
    return library_shader(name, quiet).get() == use.shader.get();
}

}  // namespace kinora
