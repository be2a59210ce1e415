// runtime/player/scene_info.h: what panels and menus list of the scene that is shown.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/player/files/shader_source.h"
#include "runtime/player/shader_document.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/ri/import/film.h"

namespace kinora {

// A node of the tree, parents first.
struct NodeInfo {
    std::string path, name;  // ids parted by '/'; what is shown
    uint32_t parent = kNone;
    uint32_t depth = 0;
    bool moves = false;    // it or a node above is animated
    bool deforms = false;  // a mesh on it changes its form
    uint32_t triangles = 0;
    std::vector<std::string> materials;
};

// A shader and who wears it: materials with the surface that is seen come first, in the order of
// the description.
struct MaterialInfo {
    std::string id, name, shader;                    // ShaderPlace's; the shader's name
    std::string target;                              // in front of ".PARAMETER"
    bool further = false;                            // no material's surface
    std::shared_ptr<const ShaderSourceText> source;  // its text as read; null: none
    std::vector<ShaderParamInfo> params;
};

struct ClipInfo {
    std::string name;
    double first = 0, last = 0;  // frames
    std::string id;
};

// Does not change; a new one comes with each scene.
struct SceneInfo {
    std::string path;
    uint64_t serial = 0;  // of scenes shown so far
    double frame_rate = 24;
    double first = 0, last = 0;  // frames
    UpAxis up_axis = UpAxis::Y;
    dvec3 low{0.0}, high{0.0};  // of the first frame
    std::vector<std::string> cameras;
    uint32_t camera = 0;              // the one of them that build_scene() chose
    std::vector<std::string> lights;  // as Scene::lights; names that occur twice have their number
    std::vector<ClipInfo> clips;
    std::vector<NodeInfo> nodes;
    std::vector<MaterialInfo> materials;
    std::vector<std::string> aovs;  // that `aov` takes, "" is the picture
    std::vector<double> keys;       // frames that have keys, sorted
    // The film whose frame this scene is; null: it is no film's. A reload makes another one.
    std::shared_ptr<const FilmFrames> film;
    size_t film_frame = 0;  // of FilmFrames::frames
    double number() const { return film->frames[film_frame].number; }
};

}  // namespace kinora
