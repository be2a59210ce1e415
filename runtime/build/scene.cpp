// runtime/build/scene.cpp: a description to a scene ready for frames.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "runtime/build/build_scene.h"
#include "runtime/build/defaults.h"
#include "runtime/build/mesh.h"
#include "runtime/build/scene_p.h"
#include "runtime/description/findings.h"
#include "runtime/images/point_store.h"
#include "runtime/images/texture.h"
#include "runtime/images/texture_store.h"
#include "runtime/scene/transforms.h"
#include "runtime/shading/shading.h"
#include "runtime/vertices/deform.h"
#include "runtime/vertices/dice_error.h"
#include "runtime/vertices/vertex_work.h"

namespace kinora {

Shape::Shape() = default;
Shape::~Shape() = default;
Shape::Shape(Shape&&) noexcept = default;
Shape& Shape::operator=(Shape&&) noexcept = default;

Scene::Scene() = default;
Scene::~Scene() = default;

SceneBuilder::SceneBuilder(std::shared_ptr<SceneDescription> description,
                           const SceneOptions& options, Diagnostics& diagnostics,
                           const BuildAgain* again)
    : description_(*description),
      diagnostics_(diagnostics),
      again_(again),
      scene_(std::make_unique<Scene>()) {
    scene_->description = std::move(description);
    scene_->options = options;
    scene_->accel = raytrace::Accel(options.accel);
    scene_->textures =
        again ? again->textures
              : std::make_shared<TextureStore>(description_.readable, options.decode_textures);
    scene_->points = std::make_shared<PointStore>(description_.readable);
}

std::unique_ptr<Scene> SceneBuilder::run() {
    find_moving_nodes();
    for (uint32_t root : description_.roots) unroll(root, kNone, dmat4(1.0));
    if (!description_.skins.empty()) ask_joints();
    evaluate(scene_->options.start_time);
    place_meshes();
    set_bounds();
    place_cameras();
    if (!choose_camera()) return nullptr;
    place_lights();
    if (stopped() || !make_looks()) return nullptr;
    if (!again_) preload_textures(description_, *scene_->textures);
    displace();
    if (stopped()) return nullptr;
    finish_rows();
    scene_->shading = std::make_unique<Shading>(*scene_);
    return std::move(scene_);
}

std::unique_ptr<Scene> build_scene(std::shared_ptr<SceneDescription> description,
                                   const SceneOptions& options, Diagnostics& diagnostics,
                                   const BuildAgain* again) {
    return SceneBuilder(std::move(description), options, diagnostics, again).run();
}

// ---- nodes
// ---------------------------------------------------------------------------------------

void SceneBuilder::find_moving_nodes() {
    for (const NodeDefinition& node : description_.nodes) {
        bool moves = false;
        for (const Transform& t : node.transforms)
            for (uint32_t i = 0; i < 16 && t.value + i < description_.animated.size(); ++i)
                moves |= description_.animated[t.value + i];
        definition_moves_.push_back(moves);
    }
}

void SceneBuilder::unroll(uint32_t definition, uint32_t parent, const dmat4& conversion) {
    Scene& scene = *scene_;
    uint32_t index = uint32_t(scene.nodes.size());
    Node node;
    node.definition = definition;
    node.parent = parent;
    node.conversion = conversion;
    node.can_move =
        definition_moves_[definition] || (parent != kNone && scene.nodes[parent].can_move);
    const NodeDefinition& from = description_.nodes[definition];
    node.hidden = from.hidden || (parent != kNone && scene.nodes[parent].hidden);
    node.chosen =
        from.chosen || (parent != kNone ? scene.nodes[parent].chosen : !description_.only_chosen);
    scene.nodes.push_back(node);
    first_occurrence_.try_emplace(definition, index);
    for (const ChildUse& child : from.children) unroll(child.node, index, child.conversion);
}

// Where the nodes are as the file leaves them and at the first keys, whatever is played.
void SceneBuilder::ask_joints() {
    auto keep = [&](std::vector<dmat4>& worlds) {
        for (const Node& node : scene_->nodes) worlds.push_back(node.world);
    };
    evaluate(std::nullopt);
    keep(rest_world_);
    evaluate(anim::time_range(description_.animation).begin);
    keep(start_world_);
}

void SceneBuilder::evaluate(std::optional<double> time) {
    Scene& scene = *scene_;
    scene.values = description_.values;
    size_t owners = description_.nodes.size() + description_.morphs.size() + 1;
    scene.changed.assign(anim::changed_words(owners), 0);
    if (time) anim::evaluate(description_.animation, *time, scene.values, scene.changed);
    scene.time = time.value_or(0);
    scene.first_frame = true;
    update_transforms(scene);
}

// The occurrence of a node definition that is nearest to `from` in the tree: joints of an instanced
// character belong to its own instance.
uint32_t SceneBuilder::nearest_occurrence(uint32_t definition, uint32_t from) const {
    if (definition == kNone) return kNone;
    const Scene& scene = *scene_;
    auto found = first_occurrence_.find(definition);
    if (found == first_occurrence_.end()) return kNone;
    auto depth_shared = [&](uint32_t a) {
        uint32_t best = 0;
        for (uint32_t x = a; x != kNone; x = scene.nodes[x].parent)
            for (uint32_t y = from; y != kNone; y = scene.nodes[y].parent)
                if (x == y) return std::max(best, x + 1);
        return best;
    };
    uint32_t best = found->second, best_shared = depth_shared(best);
    for (uint32_t n = best + 1; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].definition != definition) continue;
        uint32_t shared = depth_shared(n);
        if (shared > best_shared) {
            best = n;
            best_shared = shared;
        }
    }
    return best;
}

// ---- bounds and rows
// -----------------------------------------------------------------------------

Bounds SceneBuilder::bounds_now() const {
    const Scene& scene = *scene_;
    Bounds bounds;
    for (const Shape& shape : scene.shapes) {
        const Mesh& mesh = scene.meshes[shape.mesh];
        auto add_box = [&](const dmat4& m) {
            for (int corner = 0; corner < 8; ++corner) {
                dvec3 p((corner & 1 ? mesh.high : mesh.low).x,
                        (corner & 2 ? mesh.high : mesh.low).y,
                        (corner & 4 ? mesh.high : mesh.low).z);
                bounds.add(dvec3(m * dvec4(p, 1.0)));
            }
        };
        if (shape.kind != raytrace::GeometryKind::Deforming) {
            add_box(scene.nodes[shape.node].world * shape.conversion);
            continue;
        }
        for (const vec4& p : shape.positions) bounds.add(dvec3(p) + scene.origin);
    }
    return bounds;
}

void SceneBuilder::deform_now() {
    pose(*scene_);
    deform(*scene_);
}

void SceneBuilder::set_bounds() {
    Scene& scene = *scene_;
    // A first guess makes the scene's own size the scale of all floats: deformed about the first
    // mesh's place, then about the centre found so.
    if (!scene.shapes.empty()) {
        const Shape& first = scene.shapes.front();
        scene.origin =
            dvec3(scene.nodes[first.node].world * dvec4(scene.meshes[first.mesh].anchor, 1.0));
        for (uint32_t joint : first.joint_nodes)
            if (joint != kNone && first.in_world) scene.origin = scene.nodes[joint].world[3];
    }
    scene.geometry.resize(scene.surfaces.size());
    deform_now();
    Bounds bounds = bounds_now();
    if (bounds.empty()) {
        diagnostics_.report(Code::SCENE_EMPTY, Location{});
        bounds.add(dvec3(-1.0));
        bounds.add(dvec3(1.0));
    }
    scene.origin = 0.5 * (bounds.low + bounds.high);
    scene.low = bounds.low;
    scene.high = bounds.high;
    scene.size = std::max(glm::length(bounds.high - bounds.low), 1e-30);
    deform_now();
    bake_static(scene);
}

Bounds SceneBuilder::played_bounds() {
    constexpr int kSamples = 12;
    const SceneOptions& options = scene_->options;
    Bounds bounds = bounds_now();
    if (bounds.empty()) {  // what set_bounds takes for the scene
        bounds.add(scene_->low);
        bounds.add(scene_->high);
    }
    if (description_.animation.channels.empty() || options.end_time <= options.start_time)
        return bounds;
    for (int s = 0; s <= kSamples; ++s) {
        evaluate(options.start_time + (options.end_time - options.start_time) * s / kSamples);
        deform_now();
        Bounds now = bounds_now();
        bounds.add(now.low);
        bounds.add(now.high);
    }
    evaluate(options.start_time);
    deform_now();
    return bounds;
}

void SceneBuilder::finish_rows() {
    Scene& scene = *scene_;
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        Shape& shape = scene.shapes[surface.shape];
        const Mesh& mesh = scene.meshes[shape.mesh];
        bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
        shape.rest_positions = instanced ? mesh.positions : shape.positions;
        shape.rest_normals = instanced ? mesh.normals : shape.normals;
        raytrace::Geometry& row = scene.geometry[s];
        row.id = uint32_t(s);
        row.body = scene.surfaces[s].shape;
        row.kind = shape.kind;
        row.opaque = scene.looks[surface.look]->opaque();
        row.hide_backfaces = !mesh.double_sided || scene.looks[surface.look]->hide_backfaces;
        row.positions = shape.rest_positions;
        row.triangles = mesh.groups[surface.group].triangles;
        if (instanced)
            row.shape =
                shape_numbers_
                    .try_emplace({shape.mesh, surface.group}, uint32_t(shape_numbers_.size()))
                    .first->second;
    }
    scene.first_frame = true;
}

}  // namespace kinora
