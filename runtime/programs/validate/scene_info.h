// runtime/programs/validate/scene_info.h: what a scene holds, counted, for kinora-validate --info.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "collada/scene/scene.h"
#include "runtime/base/math.h"
#include "runtime/programs/validate/image_size.h"

namespace kinora {

struct TextureInfo {
    std::string name;  // the image's id
    std::string uri;   // as written
    bool found = false;
    uint32_t width = 0, height = 0;  // 0: not known
    std::string format;              // "png"
};

struct DocumentClip {
    std::string name;
    double start = 0, end = 0;  // seconds
    size_t channels = 0;
};

struct RestBox {
    dvec3 low{0}, high{0};
};

// Counts speak of the visual scene with instance_node unrolled: what a picture has to draw.
struct DocumentInfo {
    std::string version;  // "1.4.1"
    std::string unit;     // its name, "" if not written
    double meter = 1;
    char up = 'Y';
    size_t nodes = 0, mesh_instances = 0, cameras = 0, lights = 0;
    size_t meshes = 0;  // different ones among the instances
    size_t triangles = 0, vertices = 0, lines = 0;
    size_t uv_sets = 0;            // most on one mesh
    size_t skins = 0, joints = 0;  // different joint nodes of all skins
    size_t joints_per_skin = 0;    // most
    size_t influences = 0;         // most on one vertex, weights of 0 left out
    size_t morph_targets = 0;      // most on one mesh
    std::vector<std::string> materials;
    std::vector<TextureInfo> textures;
    std::vector<DocumentClip> clips;
    size_t channels = 0;
    std::optional<std::pair<double, double>> animated;  // first and last key, seconds
    // Of the rest pose, metres, in the file's own axes; nothing if there is no surface.
    std::optional<RestBox> bounds;
};

// What --info says of a document and of what <scene> reaches in it.
DocumentInfo scene_info(const collada::Document& document, const collada::SceneData& scene);

// scene_bounds.cpp: node transforms, skins and morph weights at their rest values, metres.
std::optional<RestBox> rest_bounds(const collada::SceneData& scene);

// The same as lines for people, and as one JSON object.
std::string info_text(const std::string& name, const DocumentInfo& info);
std::string info_json(const DocumentInfo& info);

}  // namespace kinora
