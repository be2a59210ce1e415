// runtime/player/denoise/denoiser.cpp: the steps in their order.
#include "runtime/player/denoise/denoiser.h"

#include "runtime/player/denoise/diffuse_maps.h"
#include "runtime/player/denoise/filter.h"
#include "runtime/player/denoise/history.h"
#include "runtime/scene/scene.h"

namespace kinora {

struct Denoiser::Memory {
    Planes planes;
    History history;
    AtrousFilter filter;
};

Denoiser::Denoiser() : memory_(std::make_unique<Memory>()) {}
Denoiser::~Denoiser() = default;

void Denoiser::forget() {
    memory_->history.forget();
}

bool Denoiser::filter(const Scene& scene, const Pose& pose, const FirstHits& hits,
                      raytrace::Film& film) {
    Memory& m = *memory_;
    if (!fill_planes(scene, pose, hits, film, m.planes)) {
        m.history.forget();
        return false;
    }
    fill_albedo(scene, scene, scene.textures.get(), hits, m.planes);
    m.history.blend(pose, hits, m.planes);
    m.filter.start(m.planes);
    // The next picture finds what one pass has left: less of a single bright sample stays for long.
    m.filter.pass(m.planes);
    m.history.keep(pose, m.planes);
    for (int k = 1; k < AtrousFilter::kPasses; ++k) m.filter.pass(m.planes);
    take_colors(m.planes, film);
    return true;
}

}  // namespace kinora
