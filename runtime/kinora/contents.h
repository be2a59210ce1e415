// runtime/kinora/contents.h: what a scene has that a request can name. Lists are in the scene's
// order and name each thing once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinora {

struct Scene;

struct ListedCamera {
    std::string name;    // what SceneRequest::camera takes
    std::string camera;  // its definition's id or name
    std::string node;    // ids or names of the nodes above it, parted by '/'
    bool orthographic = false;
    bool chosen = false;  // pictures are seen by it
};
std::vector<ListedCamera> listed_cameras(const Scene& scene);

struct ListedClip {
    std::string name, id;
    double start = 0, end = 0;  // seconds
};
std::vector<ListedClip> listed_clips(const Scene& scene);

struct ListedLayer {
    std::string kind, shader;
};
struct ListedMaterial {
    std::string name;
    std::vector<ListedLayer> layers;
    std::string opacity;  // "opaque", "constant opacity" or "computed opacity"
};
std::vector<ListedMaterial> listed_materials(const Scene& scene);

// A parameter of a shader, or an output.
struct ListedParameter {
    std::string name;
    std::string type;    // as RSL writes it
    std::string shader;  // that has it
};
struct ListedShader {
    std::string name, kind;
    std::vector<ListedParameter> parameters;
};
// Of each shader that the scene runs.
std::vector<ListedShader> listed_shaders(const Scene& scene);
// The shaders of ours that a request can name; they have no parameters listed.
std::vector<ListedShader> listed_library_shaders();

// What SceneRequest::params takes: NAME.PARAMETER of the materials, lights, atmospheres and
// imagers, those of added lights too.
std::vector<ListedParameter> listed_parameters(const Scene& scene);
// What SceneRequest::aovs takes: output parameters of surfaces, beside aov_rows().
std::vector<ListedParameter> listed_aovs(const Scene& scene);

struct ListedLight {
    std::string name, node, shader;
    bool area = false;  // it shines from its node's surface
};
std::vector<ListedLight> listed_lights(const Scene& scene);

// A node that bears something: what SceneRequest::hide and SceneRequest::only take.
struct ListedNode {
    std::string path, id, name;
    std::vector<std::string> meshes, lights, cameras;
    bool hidden = false;
};
std::vector<ListedNode> listed_nodes(const Scene& scene);

}  // namespace kinora
