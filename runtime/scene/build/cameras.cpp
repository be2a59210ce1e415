// runtime/scene/build/cameras.cpp: the cameras of a scene, and the one it is seen by.
#include "runtime/scene/build/cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "runtime/scene/build/added_camera.h"
#include "runtime/scene/build/coverage.h"
#include "runtime/scene/build/shapes/bounds.h"
#include "runtime/scene/build/shapes/pose_at.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

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

bool node_is(const NodeTree& tree, const CameraSource& camera, const std::string& wanted) {
    uint32_t named = tree.named(camera.node);
    const NodeDefinition& node = tree.definition(named);
    return wanted == path_of(tree, named) || wanted == node.id || wanted == node.name;
}

// Node path or id first, then camera id. kNone: there is none of that name.
uint32_t find_camera(const Scene& scene, const NodeTree& tree, const std::string& wanted) {
    auto camera_is = [&](const CameraSource& source) {
        const CameraDefinition& camera = scene.description->cameras[source.definition];
        return wanted == camera.id || wanted == camera.name;
    };
    for (bool by_node : {true, false})
        for (uint32_t c = 0; c < scene.cameras.size(); ++c) {
            const CameraSource& source = scene.cameras[c];
            if (by_node ? node_is(tree, source, wanted) : camera_is(source)) return c;
        }
    return kNone;
}

// Another field of view for the scene's camera; its window keeps its shape. False after an error.
bool change_yfov(Scene& scene, double yfov, Diagnostics& diagnostics) {
    SceneDescription& description = *scene.description;
    CameraDefinition& camera = description.cameras[scene.cameras[scene.start.camera].definition];
    if (camera.orthographic) {
        diagnostics.report(Code::CAMERA_PARALLEL, camera.where,
                           scene.cameras[scene.start.camera].name);
        return false;
    }
    std::optional<double> aspect = camera_aspect(scene);
    auto slot = [&](double number) {
        description.values.push_back(number);
        return ValueSlot{uint32_t(description.values.size() - 1), 1};
    };
    camera.window.reset();
    camera.x = {};
    camera.y = slot(yfov);
    camera.aspect = aspect ? slot(*aspect) : ValueSlot{};
    take_added_values(description, scene.start);
    return true;
}

// What has to be seen at least: of a scene that the user took parts of, anything. A file that says
// what its picture is may show nothing.
double little_of(const Scene& scene) {
    if (scene.description->file_picture) return 0;
    return takes_parts(*scene.description) ? 1e-6 : kLittle;
}

// The largest share of the camera's picture that the scene takes over the range played, as far as
// `enough`.
double most_covered(Scene& scene, double enough) {
    const SceneOptions& options = scene.options;
    double aspect = camera_aspect(scene).value_or(wanted_aspect(options));
    int width = std::max(options.width, 1);
    int height = options.height > 0 ? options.height : std::max(1, int(width / aspect + 0.5));
    double most = 0;
    std::vector<double> times = played_times(scene);
    for (double time : times) {
        if (time != options.start_time) pose_at(scene, time);
        if (!raytrace::is_error(set_view(scene, scene.start, width, height)))
            most = std::max(most, covered_share(scene, scene.start, scene.start.view, enough));
        if (most >= enough) break;
    }
    if (times.size() > 1) pose_at(scene, options.start_time);
    return most;
}

// As --camera takes it, whatever views are called.
std::string word_for(const CameraSource& camera) {
    return camera.name.empty() || find_view(camera.name) ? "#" + camera.name : camera.name;
}

// The file's, unless it shows less than `enough` of its picture.
bool choose_default(Scene& scene, NodeTree& tree, double enough, Diagnostics& diagnostics) {
    const ViewWord& view = *find_view("auto");
    if (scene.cameras.empty()) return add_camera(scene, tree, view, diagnostics);
    scene.start.camera = first_camera(scene, tree);
    double yfov = scene.options.view.yfov;
    if (yfov > 0 && !change_yfov(scene, yfov, diagnostics)) return false;
    if (!anything_to_draw(scene) || enough == 0) return true;
    double covered = most_covered(scene, enough);
    if (covered >= enough) return true;
    CameraSource blind = scene.cameras[scene.start.camera];
    Location where = scene.description->cameras[blind.definition].where;
    diagnostics.report(Code::CAMERA_SEES_LITTLE, where, blind.name, 100 * covered).help =
        fmt::format("--camera '{}' shows what it sees", word_for(blind));
    return add_camera(scene, tree, view, diagnostics);
}

}  // namespace

void add_cameras(Scene& scene, const NodeTree& tree) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const std::string& id = tree.definition(tree.named(n)).id;
        for (uint32_t camera : tree.definition(n).cameras)
            scene.cameras.push_back(
                {camera, n, id.empty() ? scene.description->cameras[camera].id : id});
    }
}

bool choose_camera(Scene& scene, NodeTree& tree, Diagnostics& diagnostics) {
    const SceneOptions& options = scene.options;
    std::string wanted = options.camera;
    if (wanted.empty() && options.view.any_place()) wanted = "auto";
    if (wanted.empty()) return choose_default(scene, tree, little_of(scene), diagnostics);
    if (const ViewWord* view = find_view(wanted))
        return add_camera(scene, tree, *view, diagnostics);
    if (wanted == "#") return choose_default(scene, tree, 0, diagnostics);
    if (wanted.starts_with("#")) wanted.erase(0, 1);
    uint32_t found = find_camera(scene, tree, wanted);
    if (found == kNone) {
        diagnostics.report(Code::CAMERA_UNKNOWN, Location{}, options.camera);
        return false;
    }
    scene.start.camera = found;
    return options.view.yfov == 0 || change_yfov(scene, options.view.yfov, diagnostics);
}

}  // namespace kinora
