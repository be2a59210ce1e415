// runtime/picture/frame/planes.cpp: the scene's outputs as planes of a film.
#include <algorithm>

#include "runtime/picture/frame/planes_p.h"

namespace kinora {

namespace {

raytrace::AovOrigin origin_of(const OutputPlane& plane) {
    switch (plane.source) {
        case AovSource::Kernel:
        case AovSource::Distance:
        case AovSource::Surface:
        case AovSource::Object:
        case AovSource::Material:
        case AovSource::Motion:
        case AovSource::Albedo:
        case AovSource::Shadow:
            return raytrace::AovOrigin::Surface;
        // Other filters are of the first surface.
        case AovSource::Emission:
        case AovSource::Direct:
        case AovSource::Indirect:
        case AovSource::Light:
        case AovSource::Rest:
            return plane.filter == raytrace::AovFilter::Mean ? raytrace::AovOrigin::Light
                                                             : raytrace::AovOrigin::Surface;
        case AovSource::CryptoObject:
        case AovSource::CryptoMaterial:
            return raytrace::AovOrigin::Coverage;
        case AovSource::Samples:
            return raytrace::AovOrigin::Samples;
        case AovSource::Variance:
            return raytrace::AovOrigin::Variance;
        case AovSource::Cost:
            return raytrace::AovOrigin::Other;
    }
    return raytrace::AovOrigin::Other;
}

bool is_same(const raytrace::AovPlane& a, const OutputPlane& b) {
    return a.name == b.name && a.filter == b.filter && a.origin == origin_of(b) && a.half == b.half;
}

}  // namespace

void prepare_planes(const SceneShaders& scene, raytrace::Film& film) {
    if (std::ranges::equal(film.aovs, scene.outputs, is_same)) return;
    film.aovs.clear();
    for (const OutputPlane& plane : scene.outputs) {
        raytrace::AovPlane& made = film.add_aov(plane.name, plane.filter);
        made.in_file = plane.in_file;
        made.background = plane.background;
        made.origin = origin_of(plane);
        made.component = int(plane.component);
        made.layer = plane.layer;
        made.half = plane.half;
        made.exact = plane.exact;
    }
}

bool has_plane_of(const SceneShaders& scene, AovSource source) {
    return std::ranges::count(scene.outputs, source, &OutputPlane::source) > 0;
}

void fill_costs(const SceneShaders& scene, const PixelCosts& costs, int samples,
                raytrace::Film& film) {
    const size_t first = size_t(film.top) * size_t(film.width);
    for (size_t p = 0; p < scene.outputs.size(); ++p) {
        if (scene.outputs[p].source != AovSource::Cost) continue;
        for (size_t i = 0; i < film.rgba.size(); ++i)
            film.aovs[p].values[i] = float(samples) + costs.rays[first + i];
    }
}

}  // namespace kinora
