// runtime/build/cameras.cpp: the cameras of a scene, and the one it is seen by.
#include "runtime/build/cameras.h"

#include <string>

#include "runtime/build/defaults.h"
#include "runtime/build/shapes/bounds.h"
#include "runtime/description/findings.h"

namespace kinora {

namespace {

void add_default_camera(Scene& scene, NodeTree& tree) {
    SceneDescription& description = *scene.description;
    DefaultCamera added =
        default_camera(played_bounds(scene), description.up_axis, description.values);
    description.cameras.push_back(added.camera);
    uint32_t node = tree.add(std::move(added.node), kNone);
    scene.cameras.push_back({uint32_t(description.cameras.size() - 1), node, "default camera"});
    scene.added.push_back("default camera");
}

// The first at or below the description's camera node; else the first.
uint32_t first_camera(const Scene& scene, const NodeTree& tree) {
    uint32_t wanted = scene.description->camera_node;
    if (wanted == kNone) return 0;
    auto below = [&](uint32_t n) {
        while (n != kNone && scene.nodes[n].definition != wanted) n = tree.parent(n);
        return n != kNone;
    };
    for (uint32_t c = 0; c < scene.cameras.size(); ++c)
        if (below(scene.cameras[c].node)) return c;
    return 0;
}

// "torso/head/eye", by ids.
std::string path_of(const NodeTree& tree, uint32_t node) {
    std::string path;
    for (uint32_t n = node; n != kNone; n = tree.parent(n)) {
        const NodeDefinition& step = tree.definition(n);
        path = (step.id.empty() ? step.name : step.id) + (path.empty() ? "" : "/" + path);
    }
    return path;
}

bool node_is(const NodeTree& tree, const CameraSource& camera, const std::string& wanted) {
    uint32_t named = tree.named(camera.node);
    const NodeDefinition& node = tree.definition(named);
    return wanted == path_of(tree, named) || wanted == node.id || wanted == node.name;
}

}  // namespace

void add_cameras(Scene& scene, NodeTree& tree) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const std::string& id = tree.definition(tree.named(n)).id;
        for (uint32_t camera : tree.definition(n).cameras)
            scene.cameras.push_back(
                {camera, n, id.empty() ? scene.description->cameras[camera].id : id});
    }
    if (scene.cameras.empty()) add_default_camera(scene, tree);
}

bool choose_camera(Scene& scene, const NodeTree& tree, Diagnostics& diagnostics) {
    const std::string& wanted = scene.options.camera;
    if (wanted.empty()) {
        scene.camera = first_camera(scene, tree);
        return true;
    }
    auto camera_is = [&](const CameraSource& source) {
        const CameraDefinition& camera = scene.description->cameras[source.definition];
        return wanted == camera.id || wanted == camera.name;
    };
    for (bool by_node : {true, false})  // node path or id first, then camera id
        for (uint32_t c = 0; c < scene.cameras.size(); ++c) {
            const CameraSource& source = scene.cameras[c];
            if (by_node ? !node_is(tree, source, wanted) : !camera_is(source)) continue;
            scene.camera = c;
            return true;
        }
    diagnostics.report(Code::CAMERA_UNKNOWN, Location{}, wanted);
    return false;
}

}  // namespace kinora
