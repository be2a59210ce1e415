// runtime/picture/shading/imager.cpp: imager shaders over the finished picture, in runs of pixels.
//
// P is the pixel's centre in the raster, Ci and alpha the pixel's (associated), Oi its coverage in
// all components: the film keeps no more. alpha becomes the picture's; an imager that leaves alpha
// alone and writes Oi sets it to the mean of Oi.
#include "runtime/picture/shading/imager.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <optional>

#include "raytrace/sampling.h"
#include "runtime/base/parallel.h"

namespace kinora {

namespace {

// Services take the pixel and position of a point from its hit: here there is a pixel only.
raytrace::HitBatch no_hits(const raytrace::Film& film, size_t first, size_t count, Arena& arena) {
    size_t rows = padded(count);
    std::span<float> zeros = arena.allocate_span<float>(rows);
    std::fill(zeros.begin(), zeros.end(), 0.0f);
    std::span<uint32_t> none = arena.allocate_span<uint32_t>(rows);
    std::fill(none.begin(), none.end(), kNone);
    std::span<uint32_t> x = arena.allocate_span<uint32_t>(rows);
    std::span<uint32_t> y = arena.allocate_span<uint32_t>(rows);
    std::span<uint32_t> nought = arena.allocate_span<uint32_t>(rows);
    for (size_t i = 0; i < rows; ++i) {
        size_t pixel = first + std::min(i, count - 1);
        x[i] = uint32_t(pixel % size_t(film.width));
        y[i] = uint32_t(pixel / size_t(film.width)) + uint32_t(film.top);
        nought[i] = 0;
    }
    raytrace::HitBatch hits;
    hits.count = count;
    hits.geometry = hits.instance = hits.primitive = none.data();
    hits.u = hits.v = hits.t = hits.time = zeros.data();
    for (size_t k = 0; k < 3; ++k) {
        hits.org[k] = hits.dir[k] = hits.P[k] = hits.P_error[k] = hits.Ng[k] = zeros.data();
        hits.dPdx[k] = hits.dPdy[k] = hits.dDdx[k] = hits.dDdy[k] = zeros.data();
    }
    hits.pixel_x = x.data();
    hits.pixel_y = y.data();
    hits.sample = hits.layer = hits.ray = nought.data();
    return hits;
}

// Planes of the film that an imager's parameter reads: one a component.
const float* plane_of(const SceneShaders& shaders, const raytrace::Film& film,
                      const VaryingParam& param, uint32_t component) {
    const float* whole = nullptr;  // of a parameter that surfaces give as one float
    for (size_t p = 0; p < shaders.outputs.size(); ++p) {
        if (shaders.outputs[p].layer != param.name || shaders.outputs[p].element > 0) continue;
        if (shaders.outputs[p].component == component) return film.aovs[p].values.data();
        if (shaders.outputs[p].component == 0) whole = film.aovs[p].values.data();
    }
    return whole;
}

struct ImagerOutputs {
    int Ci[3] = {-1, -1, -1}, Oi[3] = {-1, -1, -1}, alpha = -1;
};

ImagerOutputs find_outputs(const jit::Kernel& kernel) {
    ImagerOutputs result;
    for (size_t o = 0; o < kernel.outputs.size(); ++o) {
        rsl::KernelKey key = rsl::key_of(kernel.outputs[o]);
        if (key.kind != rsl::KeyKind::Global) continue;
        if (key.global() == rsl::Global::alpha) result.alpha = int(o);
        if (key.global() == rsl::Global::Ci) result.Ci[key.component] = int(o);
        if (key.global() == rsl::Global::Oi) result.Oi[key.component] = int(o);
    }
    return result;
}

// Replaces what is not finite; returns whether all was.
bool mend(vec4& pixel, raytrace::NanPolicy nan) {
    bool finite = true;
    for (int k = 0; k < 4; ++k) finite &= std::isfinite(pixel[k]);
    if (finite || nan == raytrace::NanPolicy::Keep) return finite;
    for (int k = 0; k < 4; ++k)
        if (!std::isfinite(pixel[k])) pixel[k] = 0;
    if (nan == raytrace::NanPolicy::Magenta) pixel = vec4(1, 0, 1, 1);
    return false;
}

bool writes(const ShaderInstance& look, rsl::Global global) {
    for (const ShaderUse& use : look.layers)
        for (const rsl::GlobalInfo* info : use.shader->globals_written)
            if (info->id == global) return true;
    return false;
}

// What the imager's kernel reads of the pixels from `first` on.
void fill_columns(Grid& grid, const raytrace::Film& film, size_t first) {
    const size_t count = grid.count();
    for (float* column : grid.columns)
        if (column) std::fill_n(column, padded(count), 0.0f);
    auto fill = [&](size_t column, auto&& value) {
        if (float* row = grid.columns[column])
            for (size_t i = 0; i < padded(count); ++i) row[i] = value(std::min(i, count - 1));
    };
    const raytrace::HitBatch& hits = grid.hits;
    fill(kColP, [&](size_t i) { return float(hits.pixel_x[i]) + 0.5f; });
    fill(kColP + 1, [&](size_t i) { return float(hits.pixel_y[i]) + 0.5f; });
    fill(kColOne, [](size_t) { return 1.0f; });
    fill(kColRng, [&](size_t i) {
        return jit::float_of(
            int32_t(raytrace::hash(hits.pixel_x[i], hits.pixel_y[i], grid.frame.seed)));
    });
    for (size_t k = 0; k < 3; ++k) {
        fill(kColCi + k, [&](size_t i) { return film.rgba[first + i][int(k)]; });
        fill(kColOi + k, [&](size_t i) { return film.rgba[first + i].w; });
    }
    fill(kColAlpha, [&](size_t i) { return film.rgba[first + i].w; });
    for (const VaryingParam& param : grid.look->varying)
        for (uint32_t c = 0; c < param.components; ++c)
            if (const float* plane = plane_of(grid.frame.shaders, film, param, c))
                fill(param.column + c, [&](size_t i) { return plane[first + i]; });
}

// What the kernel wrote, to the pixels. Returns how many were not finite.
size_t put_pixels(const Grid& grid, std::span<float* const> out, raytrace::Film& film, size_t first,
                  raytrace::NanPolicy nan) {
    const ShaderInstance& look = *grid.look;
    const ImagerOutputs outputs = find_outputs(look.full.kernel());
    const bool mean_of_Oi =
        writes(look, rsl::Global::Oi) && !writes(look, rsl::Global::alpha) && outputs.Oi[0] >= 0;
    size_t bad = 0;
    for (size_t i = 0; i < grid.count(); ++i) {
        auto value = [&](int output, float otherwise) {
            return output < 0 ? otherwise : out[size_t(output)][i];
        };
        vec4& pixel = film.rgba[first + i];
        float alpha = value(outputs.alpha, pixel.w);
        if (mean_of_Oi)
            alpha =
                (value(outputs.Oi[0], 1) + value(outputs.Oi[1], 1) + value(outputs.Oi[2], 1)) / 3;
        for (int k = 0; k < 3; ++k) pixel[k] = value(outputs.Ci[k], pixel[k]);
        pixel.w = alpha;
        bad += !mend(pixel, nan);
    }
    return bad;
}

}  // namespace

size_t Imager::run_pixels(raytrace::Film& film, size_t first, size_t count,
                          raytrace::NanPolicy nan) {
    const ShaderInstance& look = *frame_.shaders.shader_instances[frame_.shaders.imager];
    ThreadMemory& memory = *threads_[size_t(thread_index())];
    Arena& arena = memory.arena;
    Arena::Mark mark = arena.mark();
    raytrace::HitBatch hits = no_hits(film, first, count, arena);
    std::span<uint32_t> points = arena.allocate_span<uint32_t>(count);
    for (uint32_t i = 0; i < count; ++i) points[i] = i;
    Grid grid(frame_, memory, hits, points, &look);
    kernels_.prepare(grid, {});
    want_columns(grid, look.full.columns);
    fill_columns(grid, film, first);
    const size_t bad = put_pixels(grid, kernels_.run(look.full, grid), film, first, nan);
    arena.release(mark);
    return bad;
}

size_t Imager::run(raytrace::Film& film, raytrace::NanPolicy nan) {
    size_t runs = (film.rgba.size() + kGridPoints - 1) / kGridPoints;
    std::atomic<size_t> bad = 0;
    parallel_for(0, runs, 1, [&](size_t begin, size_t end) {
        std::optional<raytrace::DenormalGuard> flush;
        if (frame_.quality.math == jit::math::Tier::Fast) flush.emplace();
        for (size_t r = begin; r < end; ++r)
            bad += run_pixels(film, r * kGridPoints,
                              std::min(kGridPoints, film.rgba.size() - r * kGridPoints), nan);
    });
    return bad;
}

}  // namespace kinora
