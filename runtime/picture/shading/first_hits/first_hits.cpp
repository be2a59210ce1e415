// runtime/picture/shading/first_hits/first_hits.cpp: hits to their pixels; marks that threads set
// together.
#include "runtime/picture/shading/first_hits/first_hits.h"

#include <algorithm>
#include <atomic>

#include "raytrace/hits.h"

namespace kinora {

namespace {

// Threads may do so at once; nobody reads before the picture is done.
void mark(uint8_t& flag) {
    std::atomic_ref<uint8_t> shared(flag);
    if (!shared.load(std::memory_order_relaxed)) shared.store(1, std::memory_order_relaxed);
}

}  // namespace

bool FirstHits::any_noise() const {
    return std::ranges::find(noisy, uint8_t(1)) != noisy.end();
}

void FirstHits::start(int picture_width, int picture_height, size_t shader_instances) {
    noisy.assign(shader_instances, 0);
    width = picture_width;
    height = picture_height;
    if (!places) return;
    const size_t pixels = size_t(width) * size_t(height);
    surface.assign(pixels, raytrace::kNone);
    for (auto* plane : {&u, &v}) plane->resize(pixels);
    for (auto* plane : {&P, &Ng}) plane->resize(pixels);
    primitive.resize(pixels);
}

void FirstHits::take(const raytrace::HitBatch& hits) {
    if (!places) return;
    for (size_t h = 0; h < hits.count; ++h) {
        if (hits.sample[h] != 0 || hits.layer[h] != 0) continue;
        const size_t pixel = size_t(hits.pixel_y[h]) * size_t(width) + hits.pixel_x[h];
        surface[pixel] = hits.instance[h];
        primitive[pixel] = hits.primitive[h];
        u[pixel] = hits.u[h];
        v[pixel] = hits.v[h];
        P[pixel] = triple(hits.P, h);
        Ng[pixel] = triple(hits.Ng, h);
    }
}

void FirstHits::note_random(size_t shader_instance, uint32_t depth) {
    if (depth == 0) mark(noisy[shader_instance]);
}

}  // namespace kinora
