// runtime/scene/ri/state/maps.cpp: textures, environments and shadows by the names that files give
// them.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/kept_picture.h"
#include "runtime/scene/description/memory_file.h"
#include "runtime/scene/ri/state/shader_calls.h"

namespace kinora::ri {
namespace {

namespace fs = std::filesystem;

// What renderers make of pictures, and the pictures that may lie beside it still.
constexpr std::string_view kMade[] = {".tx", ".tex", ".txr", ".tdl", ".env", ".map"};
constexpr std::string_view kPictures[] = {".tif", ".tiff", ".png", ".jpg", ".jpeg",
                                          ".exr", ".tga",  ".bmp", ".sgi", ".gif"};

bool is_file(const std::string& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

bool names_shadow(std::string_view parameter) {
    std::string lower(parameter);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower.find("shadow") != lower.npos || lower.find("shd") != lower.npos;
}

TextureWrap wrap_of(std::string_view mode) {
    return mode == "clamp"      ? TextureWrap::Clamp
           : mode == "periodic" ? TextureWrap::Wrap
                                : TextureWrap::Border;
}

}  // namespace

void ShaderCalls::make_map(const Call& call) {
    MadeMap made;
    made.one.path = call.arguments[0].string();
    if (call.request != Request::MakeLatLongEnvironment) {
        made.one.wrap_s = wrap_of(call.arguments[2].string());
        made.one.wrap_t = wrap_of(call.arguments[3].string());
    }
    maps_.insert_or_assign(std::string(call.arguments[1].string()), std::move(made));
}

void ShaderCalls::make_cube_map(const Call& call) {
    MadeMap made;
    CubeName& cube = made.six.emplace();
    for (size_t face = 0; face < 6; ++face) cube.faces[face] = call.arguments[face].string();
    cube.fov = double(call.arguments[7].real());
    if (!(cube.fov >= 90 && cube.fov < 180)) {
        report_.add(Code::RI_RANGE, "MakeCubeFaceEnvironment",
                    "fov lies not between 90 and 180 degrees");
        cube.fov = 90;
    }
    maps_.insert_or_assign(std::string(call.arguments[6].string()), std::move(made));
}

void ShaderCalls::make_shadow(const Call& call) {
    shadows_.insert(std::string(call.arguments[1].string()));
}

// The file of that name along the search path; else the picture that it was made of, or one with
// another suffix. "": none.
std::string ShaderCalls::picture_file(const std::string& name, bool any_suffix) const {
    for (const std::string& folder : folders("texture"))
        if (is_file(folder + name)) return folder + name;
    fs::path stem = name;
    if (!any_suffix && std::ranges::find(kMade, stem.extension().string()) == std::end(kMade))
        return "";
    for (std::string_view suffix : kPictures) {
        stem.replace_extension(suffix);
        for (const std::string& folder : folders("texture"))
            if (is_file(folder + stem.string())) return folder + stem.string();
    }
    return "";
}

// Notes it where an earlier world of the file has made it. Null: none has.
const MapPicture* ShaderCalls::use_picture(const std::string& picture) {
    const auto maker = makers_.find(picture);
    if (maker == makers_.end()) return nullptr;
    return &*used_.insert({maker->second, picture}).first;
}

void ShaderCalls::end_world(int world, bool all_maps, FilePicture& picture) {
    if (all_maps)
        for (const auto& [name, map] : maps_) {
            use_picture(map.one.path);
            if (map.six)
                for (const std::string& face : map.six->faces) use_picture(face);
        }
    const std::set<MapPicture> used = std::exchange(used_, outside_);
    picture.map_pictures.assign(used.begin(), used.end());
    for (const FileDisplay& display : picture.displays) makers_[display.name] = world;
}

// One that an earlier world of the file has made for this, else a file. Displays are written as PNG
// or EXR, whatever suffix their names have.
std::string ShaderCalls::made_picture(const std::string& picture) {
    if (const MapPicture* made = use_picture(picture)) {
        const std::string kept = kept_picture_name(state_.path, *made);
        if (is_memory_file(kept)) return kept;
    }
    std::string file = picture_file(picture, true);
    return file.empty() ? picture : file;
}

// What a string of a shader's parameters means. Depth maps of a file that renders them itself, and
// those that are not there, are traced.
std::string ShaderCalls::map_name(std::string_view parameter, const std::string& name,
                                  const rsl::Shader& shader) {
    if (name.empty() || name == "raytrace") return name;
    if (auto made = maps_.find(name); made != maps_.end()) {
        MadeMap map = made->second;
        if (map.six)
            for (std::string& face : map.six->faces) face = made_picture(face);
        map.one.path = map.six ? cube_name_string(*map.six) : made_picture(map.one.path);
        return texture_name_string(map.one);
    }
    bool made_here = shadows_.contains(name);
    std::string file = made_here ? "" : picture_file(name, false);
    if (!file.empty()) return file;
    bool shadow = shader.kind == rsl::ShaderKind::Light && names_shadow(parameter);
    if (!made_here && !shadow) return name;
    if (report_.is_new("shadow " + name)) report_.add(Code::RI_SHADOW_TRACED, name);
    return "raytrace";
}

}  // namespace kinora::ri
