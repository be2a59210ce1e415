// runtime/programs/validate/scene_info_print.cpp: a scene's counts as text and JSON.
#include <fmt/format.h>

#include "runtime/programs/validate/escaped_text.h"
#include "runtime/programs/validate/scene_info.h"

namespace kinora {

namespace {

struct Count {
    const char* name;
    size_t DocumentInfo::*member;
};
constexpr Count kCounts[] = {
    {"triangles", &DocumentInfo::triangles},
    {"vertices", &DocumentInfo::vertices},
    {"lines", &DocumentInfo::lines},
    {"nodes", &DocumentInfo::nodes},
    {"mesh_instances", &DocumentInfo::mesh_instances},
    {"meshes", &DocumentInfo::meshes},
    {"skins", &DocumentInfo::skins},
    {"joints", &DocumentInfo::joints},
    {"joints_per_skin", &DocumentInfo::joints_per_skin},
    {"influences", &DocumentInfo::influences},
    {"morph_targets", &DocumentInfo::morph_targets},
    {"uv_sets", &DocumentInfo::uv_sets},
    {"cameras", &DocumentInfo::cameras},
    {"lights", &DocumentInfo::lights},
    {"channels", &DocumentInfo::channels},
};

std::string vector_json(const dvec3& v) {
    return fmt::format("[{}, {}, {}]", json_number(v.x), json_number(v.y), json_number(v.z));
}

std::string texture_text(const TextureInfo& texture) {
    if (!texture.found) return fmt::format("{} (not there)", texture.uri);
    if (texture.format.empty()) return fmt::format("{} (size not known)", texture.uri);
    return fmt::format("{} ({}x{} {})", texture.uri, texture.width, texture.height, texture.format);
}

template <class T, class Make>
std::string list_json(const std::vector<T>& list, Make make) {
    std::string text = "[";
    for (const T& item : list) text += (text.size() > 1 ? ", " : "") + make(item);
    return text + "]";
}

std::string texture_json(const TextureInfo& t) {
    return fmt::format(
        "{{\"name\": {}, \"uri\": {}, \"found\": {}, \"width\": {}, \"height\": {}, \"format\": "
        "{}}}",
        json_string(t.name), json_string(t.uri), t.found, t.width, t.height, json_string(t.format));
}

std::string clip_json(const DocumentClip& c) {
    return fmt::format("{{\"name\": {}, \"start\": {}, \"end\": {}, \"channels\": {}}}",
                       json_string(c.name), json_number(c.start), json_number(c.end), c.channels);
}

}  // namespace

std::string info_text(const std::string& name, const DocumentInfo& info) {
    std::string text = fmt::format("{}: COLLADA {}, unit {}{} m, {}_UP\n", name, info.version,
                                   info.unit.empty() ? "" : info.unit + " = ", info.meter, info.up);
    for (const Count& count : kCounts)
        text += fmt::format("    {:<16} {}\n", count.name, info.*count.member);
    text += fmt::format("    {:<16} {}\n", "materials", info.materials.size());
    for (const std::string& material : info.materials)
        text += fmt::format("        {}\n", material);
    text += fmt::format("    {:<16} {}\n", "textures", info.textures.size());
    for (const TextureInfo& texture : info.textures)
        text += fmt::format("        {}\n", texture_text(texture));
    text += fmt::format("    {:<16} {}\n", "clips", info.clips.size());
    for (const DocumentClip& clip : info.clips)
        text += fmt::format("        {}: {} s to {} s, {} channels\n", clip.name, clip.start,
                            clip.end, clip.channels);
    if (info.animated)
        text += fmt::format("    {:<16} {} s to {} s\n", "animated", info.animated->first,
                            info.animated->second);
    if (info.bounds)
        text += fmt::format("    {:<16} {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g} m\n", "bounds",
                            info.bounds->low.x, info.bounds->low.y, info.bounds->low.z,
                            info.bounds->high.x, info.bounds->high.y, info.bounds->high.z);
    return text;
}

std::string info_json(const DocumentInfo& info) {
    std::string text = fmt::format(
        "{{\"version\": {}, \"unit\": {}, \"meter\": {}, \"up_axis\": \"{}\"",
        json_string(info.version), json_string(info.unit), json_number(info.meter), info.up);
    for (const Count& count : kCounts)
        text += fmt::format(", \"{}\": {}", count.name, info.*count.member);
    text += ", \"materials\": " +
            list_json(info.materials, [](const std::string& m) { return json_string(m); });
    text += ", \"textures\": " + list_json(info.textures, texture_json);
    text += ", \"clips\": " + list_json(info.clips, clip_json);
    if (info.animated)
        text += fmt::format(", \"animated\": [{}, {}]", json_number(info.animated->first),
                            json_number(info.animated->second));
    if (info.bounds)
        text += fmt::format(", \"bounds\": {{\"min\": {}, \"max\": {}}}",
                            vector_json(info.bounds->low), vector_json(info.bounds->high));
    return text + "}";
}

}  // namespace kinora
