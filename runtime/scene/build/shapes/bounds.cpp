// runtime/scene/build/shapes/bounds.cpp: how large a scene is and where.
#include "runtime/scene/build/shapes/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/scene/build/shapes/pose_at.h"
#include "runtime/scene/build/shapes/shown_vertices.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/vertices/deform.h"

namespace kinora {

namespace {

bool has_triangles(const Mesh& mesh) {
    return mesh.low.x <= mesh.high.x;
}

// One triangle with an area is enough.
bool has_area(const Mesh& mesh) {
    for (const MeshGroup& group : mesh.groups)
        for (size_t c = 0; c + 2 < group.triangles.size(); c += 3) {
            auto at = [&](size_t k) { return dvec3(mesh.positions[group.triangles[c + k]]); };
            dvec3 n = glm::cross(at(1) - at(0), at(2) - at(0));
            if (n.x != 0 || n.y != 0 || n.z != 0) return true;  // NaN is told elsewhere
        }
    return false;
}

void add_box(const Mesh& mesh, const dmat4& world_from_mesh, Bounds& bounds) {
    if (!has_triangles(mesh)) return;
    for (int corner = 0; corner < 8; ++corner) {
        dvec3 p((corner & 1 ? mesh.high : mesh.low).x, (corner & 2 ? mesh.high : mesh.low).y,
                (corner & 4 ? mesh.high : mesh.low).z);
        bounds.add(dvec3(world_from_mesh * dvec4(p, 1.0)));
    }
}

Bounds bounds_now(const Scene& scene) {
    Bounds bounds;
    for (size_t s = 0; s < scene.shapes.size(); ++s) {
        const Shape& shape = scene.shapes[s];
        if (shape.kind != raytrace::GeometryKind::Deforming) {
            add_box(scene.meshes[shape.mesh],
                    scene.start.nodes[shape.node].world * shape.conversion, bounds);
            continue;
        }
        for (const vec4& p : scene.start.shapes[s].positions) bounds.add(dvec3(p) + scene.origin);
    }
    return bounds;
}

// The bounds' centre; where they are so wide that its floats would leave small meshes no digits,
// the centre of the shape that is nearest to the world's 0: things are hidden by moving them far
// away.
dvec3 origin_within(const Scene& scene, const Bounds& bounds) {
    constexpr double kWide = 1e5;  // times a mesh's own size
    dvec3 centre = 0.5 * (bounds.low + bounds.high);
    double size = glm::length(bounds.high - bounds.low);
    bool any_small = std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) {
        return has_triangles(mesh) && kWide * glm::length(dvec3(mesh.high - mesh.low)) < size;
    });
    if (!any_small) return centre;
    ShownVertices vertices(scene, scene.start);
    dvec3 nearest = centre;
    for (uint32_t h = 0; h < scene.shapes.size(); ++h) {
        Bounds shape;
        for (const dvec3& p : vertices.of(h)) shape.add(p);
        dvec3 middle = 0.5 * (shape.low + shape.high);
        bool small = kWide * glm::length(shape.high - shape.low) < size;
        if (!shape.empty() && small && glm::length(middle) < glm::length(nearest)) nearest = middle;
    }
    return nearest;
}

// The centre of the first mesh, or its last joint.
dvec3 first_origin(const Scene& scene) {
    const Shape& first = scene.shapes.front();
    dvec3 origin(scene.start.nodes[first.node].world * dvec4(scene.meshes[first.mesh].anchor, 1.0));
    for (uint32_t joint : first.joint_nodes)
        if (joint != kNone && first.in_world) origin = scene.start.nodes[joint].world[3];
    return origin;
}

}  // namespace

void Bounds::add(dvec3 p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return;
    low = glm::min(low, p);
    high = glm::max(high, p);
}

void set_bounds(Scene& scene) {
    // A first guess makes the scene's own size the scale of all floats: deformed about the first
    // mesh, then about the centre found so.
    if (!scene.shapes.empty()) scene.origin = first_origin(scene);
    scene.start.rows.resize(scene.surfaces.size());
    pose_now(scene);
    Bounds bounds = bounds_now(scene);
    if (bounds.empty()) {
        bounds.add(dvec3(-1.0));
        bounds.add(dvec3(1.0));
    }
    scene.origin = origin_within(scene, bounds);
    scene.low = bounds.low;
    scene.high = bounds.high;
    scene.size = std::max(glm::length(bounds.high - bounds.low), 1e-30);
    pose_now(scene);
    bake_static(scene);
}

bool anything_to_draw(const Scene& scene) {
    return std::ranges::any_of(scene.shapes, [&](const Shape& shape) {
        const ShapePose& stands = scene.start.shapes[size_t(&shape - scene.shapes.data())];
        const Mesh& mesh = scene.meshes[shape.mesh];
        if (!has_triangles(mesh)) return false;
        if (shape.kind == raytrace::GeometryKind::Deforming) return true;
        return has_area(mesh) && (scene.nodes[shape.node].can_move || !is_singular(stands));
    });
}

bool takes_parts(const SceneDescription& description) {
    return description.only_chosen ||
           std::ranges::any_of(description.nodes, &NodeDefinition::hidden);
}

std::vector<double> played_times(const SceneResources& scene, int most) {
    const SceneOptions& options = scene.options;
    double length = options.end_time - options.start_time;
    if (scene.description->animation.channels.empty() || !(length > 0)) return {options.start_time};
    std::vector<double> times;
    for (int s = 0; s < most; ++s)
        times.push_back(options.start_time + length * (double(s) / (most - 1)));
    return times;
}

}  // namespace kinora
