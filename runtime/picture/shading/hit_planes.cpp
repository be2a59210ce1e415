// runtime/picture/shading/hit_planes.cpp: distances and numbers of hits.
#include "runtime/picture/shading/hit_planes.h"

#include <algorithm>

#include "runtime/scene/names.h"

namespace kinora {

namespace {

const Surface& surface_of(const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k) {
    return frame.shapes.surfaces[hits.geometry[k]];
}

struct Row {
    AovSource source;
    float (*number)(const ShadingFrame&, const raytrace::HitBatch&, size_t k);
};
constexpr Row kRows[] = {
    {AovSource::Distance,
     [](const ShadingFrame&, const raytrace::HitBatch& hits, size_t k) { return hits.t[k]; }},
    {AovSource::Surface, [](const ShadingFrame&, const raytrace::HitBatch& hits,
                            size_t k) { return float(hits.geometry[k] + 1); }},
    {AovSource::Object,
     [](const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k) {
         return float(object_id(frame.shapes, surface_of(frame, hits, k)));
     }},
    {AovSource::Material, [](const ShadingFrame& frame, const raytrace::HitBatch& hits,
                             size_t k) { return float(material_id(surface_of(frame, hits, k))); }},
};

}  // namespace

void fill_hit_planes(const ShadingFrame& frame, const raytrace::HitBatch& hits,
                     const raytrace::ShadeResult& result) {
    const std::vector<OutputPlane>& planes = frame.shaders.outputs;
    for (size_t p = 0; p < std::min(planes.size(), result.aov.size()); ++p) {
        const auto* row = std::ranges::find(kRows, planes[p].source, &Row::source);
        if (row == std::end(kRows)) continue;
        for (size_t k = 0; k < hits.count; ++k) result.aov[p][k] = row->number(frame, hits, k);
    }
}

}  // namespace kinora
