// runtime/picture/shading/hit_planes.cpp: distances and numbers of hits.
#include "runtime/picture/shading/hit_planes.h"

#include <algorithm>

#include "raytrace/camera.h"
#include "runtime/scene/aovs/cryptomatte.h"
#include "runtime/scene/names.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

const Surface& surface_of(const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k) {
    return frame.shapes.surfaces[hits.geometry[k]];
}

// Where the point of a hit is in a pose, accel space.
dvec3 place_in(const Pose& pose, const raytrace::HitBatch& hits, size_t k) {
    const raytrace::Geometry& row = pose.rows[hits.instance[k]];
    const uint32_t* corner = &row.triangles[3 * size_t(hits.primitive[k])];
    const double u = double(hits.u[k]), v = double(hits.v[k]), weights[3] = {1 - u - v, u, v};
    dvec3 place(0.0);
    for (int c = 0; c < 3; ++c) place += weights[c] * dvec3(vec3(row.positions[corner[c]]));
    if (row.kind != raytrace::GeometryKind::Instanced) return place;
    return dvec3(row.accel_from_local * dvec4(place, 1.0));
}

// Pixels from where a pose sees the hit's point to where a later one does, y up; 0 where one of
// them does not see it.
dvec2 motion_between(const Pose& from, const Pose& to, const raytrace::HitBatch& hits, size_t k) {
    const auto begin = raytrace::raster_position(from.view, place_in(from, hits, k));
    const auto end = raytrace::raster_position(to.view, place_in(to, hits, k));
    return begin && end ? dvec2(end->x - begin->x, begin->y - end->y) : dvec2(0.0);
}

float motion_at(const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k,
                uint32_t component) {
    const NeighbourPoses& beside = *frame.pose.neighbours;
    const bool next = component < 2;
    if (!(next ? beside.after_seen : beside.before_seen)) return 0;
    const dvec2 motion = next ? motion_between(frame.pose, beside.after, hits, k)
                              : motion_between(beside.before, frame.pose, hits, k);
    return float(motion[int(component % 2)]);
}

struct PlaneRow {
    AovSource source;
    float (*number)(const ShadingFrame&, const raytrace::HitBatch&, size_t k, uint32_t component);
};
constexpr PlaneRow kRows[] = {
    {AovSource::Distance, [](const ShadingFrame&, const raytrace::HitBatch& hits, size_t k,
                             uint32_t) { return hits.t[k]; }},
    {AovSource::Surface, [](const ShadingFrame&, const raytrace::HitBatch& hits, size_t k,
                            uint32_t) { return float(hits.geometry[k] + 1); }},
    {AovSource::Object,
     [](const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k, uint32_t) {
         return float(object_id(frame.shapes, surface_of(frame, hits, k)));
     }},
    {AovSource::Material, [](const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k,
                             uint32_t) { return float(material_id(surface_of(frame, hits, k))); }},
    {AovSource::Motion, motion_at},
    {AovSource::CryptoObject,
     [](const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k, uint32_t component) {
         return component == 0 ? frame.object_crypto[hits.geometry[k]] : 0;
     }},
    {AovSource::CryptoMaterial,
     [](const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k, uint32_t component) {
         return component == 0 ? frame.material_crypto[hits.geometry[k]] : 0;
     }},
};

}  // namespace

void hash_names(const Scene& scene, ShadingFrame& frame) {
    for (const OutputPlane& plane : scene.outputs) {
        if (plane.component != 0) continue;
        for (const Surface& surface : scene.surfaces) {
            if (plane.source == AovSource::CryptoObject)
                frame.object_crypto.push_back(
                    crypto_id(node_path(scene, scene.shapes[surface.shape].node)));
            if (plane.source == AovSource::CryptoMaterial)
                frame.material_crypto.push_back(
                    crypto_id(material_name(*scene.description, surface.material)));
        }
    }
}

void fill_hit_planes(const ShadingFrame& frame, const raytrace::HitBatch& hits,
                     const raytrace::ShadeResult& result) {
    const std::vector<OutputPlane>& planes = frame.shaders.outputs;
    for (size_t p = 0; p < std::min(planes.size(), result.aov.size()); ++p) {
        const auto* row = std::ranges::find(kRows, planes[p].source, &PlaneRow::source);
        if (row == std::end(kRows)) continue;
        for (size_t k = 0; k < hits.count; ++k)
            result.aov[p][k] = row->number(frame, hits, k, planes[p].component);
    }
}

}  // namespace kinora
