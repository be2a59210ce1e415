// runtime/scene/build/build_scene.cpp: from a description to a scene ready for frames.
#include "runtime/scene/build/build_scene.h"

#include <algorithm>

#include "raytrace/ray_tracer.h"
#include "runtime/base/raise_findings.h"
#include "runtime/scene/build/cameras.h"
#include "runtime/scene/build/displacement/displacement.h"
#include "runtime/scene/build/instances/instances.h"
#include "runtime/scene/build/lights.h"
#include "runtime/scene/build/rows.h"
#include "runtime/scene/build/shapes/bounds.h"
#include "runtime/scene/build/shapes/node_tree.h"
#include "runtime/scene/build/shapes/shapes.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/point_store.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"
#include "runtime/scene/vertices/dice_error.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {

namespace {

std::unique_ptr<Scene> empty_scene(std::shared_ptr<SceneDescription> description,
                                   const SceneOptions& options,
                                   std::shared_ptr<TextureStore> textures) {
    auto scene = std::make_unique<Scene>();
    if (!textures)
        textures = std::make_shared<TextureStore>(description->pictures, options.decode_textures,
                                                  description->textures_from_top);
    scene->textures = std::move(textures);
    scene->points = std::make_shared<PointStore>(description->readable);
    scene->description = std::move(description);
    scene->options = options;
    return scene;
}

// Fast kernels square areas as floats and flush denormals: beyond these sizes normals would vanish,
// and kernels are precise.
void suit_math(Scene& scene) {
    constexpr double kLeast = 1e-6, kMost = 1e8;  // docs/numerics.md#two-tiers
    if (!(scene.size >= kLeast && scene.size <= kMost))
        scene.options.quality.math = jit::math::Tier::Precise;
}

// What fills a picture without surfaces.
bool has_picture_shaders(const SceneDescription& description) {
    auto any = [](const PictureShaders& picture) {
        return !picture.atmosphere.empty() || !picture.imagers.empty();
    };
    return description.environment || any(description.picture) ||
           std::ranges::any_of(description.cameras,
                               [&](const CameraDefinition& camera) { return any(camera.picture); });
}

// What frames pose again: each pose has vertices of its own.
void drop_vertices(Pose& start) {
    start.shapes.clear();
    start.rows.clear();
    start.vertex_outputs.clear();
    start.watched.clear();
}

// False, with an error, for a file that holds nothing to see. What the user hides is no error, nor
// is an empty picture where the file says what its picture is.
bool something_to_draw(const Scene& scene, Diagnostics& diagnostics) {
    const SceneDescription& description = *scene.description;
    if (anything_to_draw(scene) || has_picture_shaders(description)) return true;
    if (description.file_picture) return true;
    bool hidden = takes_parts(description);
    if (!hidden && raise_findings(diagnostics, "XML_")) return false;
    diagnostics.report(hidden ? Code::SCENE_HIDDEN : Code::SCENE_EMPTY, Location{});
    return hidden;
}

}  // namespace

std::unique_ptr<Scene> build_scene(std::shared_ptr<SceneDescription> description,
                                   const SceneOptions& options, Diagnostics& diagnostics,
                                   const BuildAgain* again) {
    const std::atomic<bool>* stop = again ? again->stop : nullptr;
    auto stopped = [&] { return stop && *stop; };
    std::unique_ptr<Scene> made =
        empty_scene(std::move(description), options, again ? again->textures : nullptr);
    Scene& scene = *made;
    SceneNodes& nodes = scene;
    SceneShapes& shapes = scene;

    NodeTree tree(nodes, scene.start);
    SkinBinder skins(nodes, tree, node_poses(nodes, scene.start), diagnostics);
    evaluate_anew(scene, scene.start, options.start_time);
    std::vector<SurfaceUse> uses = add_shapes(nodes, shapes, scene.start, skins, diagnostics);
    if (!something_to_draw(scene, diagnostics)) return nullptr;
    set_bounds(scene);
    suit_math(scene);

    add_cameras(scene, tree);
    if (!choose_camera(scene, tree, diagnostics)) return nullptr;
    if (!add_lights(scene, tree, uses, diagnostics)) return nullptr;

    if (stopped() || !add_instances(scene, uses, diagnostics)) return nullptr;
    if (!again) preload_textures(*scene.description, *scene.textures);
    displace(scene, uses, again && again->view ? &*again->view : nullptr, stop, diagnostics);
    if (stopped()) return nullptr;

    if (const std::string& why = raytrace::ray_tracer_error(); !why.empty()) {
        diagnostics.report(Code::RAY_TRACER_MISSING, Location{}, why);
        return nullptr;
    }
    scene.baked_samplers = anim::baked(scene.description->animation, key_options(options.quality));
    set_rows(shapes, scene);
    find_moving_parts(nodes, shapes);
    if (scene.moving.surfaces.empty()) scene.still_tree = std::make_shared<StillTree>();
    drop_vertices(scene.start);
    return made;
}

}  // namespace kinora
