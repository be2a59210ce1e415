// runtime/picture/shading/light_layers.cpp: some of a shader's light: its runs, and their sums.
#include "runtime/picture/shading/light_layers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/ranges.h>

#include "raytrace/hits.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/rays/kinds.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

using Kind = LightLayer::Kind;
using Color = std::array<const float*, 3>;  // null where the kernel has no Ci

bool has_plane(const LightLayer& layer) {
    return layer.plane != LightLayer::kNoPlane;
}

// One launch after the other, whose outputs are let go together.
class Runs {
  public:
    Runs(Grid& grid, const BoundKernel& bound, const KernelRunner& kernels)
        : grid_(grid), bound_(bound), kernels_(kernels), mark_(grid.memory.arena.mark()) {}
    ~Runs() { grid_.memory.arena.release(mark_); }
    Runs(const Runs&) = delete;

    Color of(const LightPart& part) const {
        const std::span<float*> out = kernels_.run_part(bound_, grid_, part);
        float* Ci[3];
        find_color(bound_.kernel(), out, rsl::Global::Ci, Ci);
        return {Ci[0], Ci[1], Ci[2]};
    }

  private:
    Grid& grid_;
    const BoundKernel& bound_;
    const KernelRunner& kernels_;
    const Arena::Mark mark_;
};

// Whether the part may differ from none at the grid's points.
bool reaches(const Grid& grid, const LightPart& part) {
    if (!grid.tape->empty()) return true;
    const jit::RecordSet& set = grid.record_sets[0];
    return std::any_of(set.records, set.records + set.count, [&](const jit::Record& record) {
        const int32_t light = jit::bits_of(record.uniforms[rsl::kLightNumber]);
        return part.has(size_t(light)) || record.columns[rsl::kLightLamp];
    });
}

float value_at(const Color& color, size_t c, size_t i) {
    return color[c] ? color[c][i] : 0.0f;
}

// What layers of a grid's points are put together from.
struct Sums {
    const Grid& grid;
    const raytrace::ShadeResult& result;
    std::span<double> total;  // of the layers that add up, and their sizes: six a point
    Color dark;

    float& plane(const LightLayer& layer, size_t c, size_t i) const {
        return result.aov[layer.plane + c][grid.points[i]];
    }
    void count(size_t c, size_t i, double value) const {
        total[6 * i + c] += value;
        total[6 * i + 3 + c] += std::abs(value);
    }
};

void add_layer(const Sums& sums, const LightLayer& layer, const Color& lit) {
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < sums.grid.count(); ++i) {
            const float value = value_at(lit, c, i) - value_at(sums.dark, c, i);
            if (has_plane(layer)) sums.plane(layer, c, i) = value;
            if (layer.adds_up) sums.count(c, i, double(value));
        }
}

// What the points show beside their kernel's Ci is light of lamps, which is emission.
void add_emission(const Sums& sums, const LightLayer& layer, const float* const Ci[3]) {
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < sums.grid.count(); ++i) {
            const float own = Ci[c] ? Ci[c][i] : 0.0f,
                        shown = sums.result.Ci[c][sums.grid.points[i]];
            const float dark = value_at(sums.dark, c, i);
            if (has_plane(layer)) sums.plane(layer, c, i) = dark + (shown - own);
            sums.count(c, i, double(dark));
        }
}

// The share of the unshadowed light that is missing.
void add_shadow(const Sums& sums, const LightLayer& layer, const Color& bare, const Color& lit) {
    for (size_t i = 0; i < sums.grid.count(); ++i) {
        double open = 0, arrives = 0;
        for (size_t c = 0; c < 3; ++c) {
            open += double(value_at(bare, c, i)) - double(value_at(sums.dark, c, i));
            arrives += double(value_at(lit, c, i)) - double(value_at(sums.dark, c, i));
        }
        const double hidden = open > 0 ? 1 - arrives / open : 0;
        sums.plane(layer, 0, i) = float(std::clamp(hidden, 0.0, 1.0));
    }
}

void judge(const Sums& sums, const float* const Ci[3], LayerErrors& errors) {
    float worst = 0;
    for (size_t i = 0; i < sums.grid.count(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const double shown = Ci[c] ? double(Ci[c][i]) : 0;
            const double size = std::max(std::abs(shown), sums.total[6 * i + 3 + c]);
            const double error = std::abs(shown - sums.total[6 * i + c]);
            if (error > 0 && std::isfinite(error)) worst = std::max(worst, float(error / size));
        }
    errors.add(sums.grid.look->index, worst);
}

}  // namespace

bool report_layer_errors(const SceneShaders& shaders, const LayerErrors& errors,
                         Diagnostics& diagnostics) {
    constexpr float kTolerance = 1e-4f;  // of float sums; what is not linear misses by far more
    std::vector<std::string> names;
    float worst = 0;
    for (size_t look = 0; look < errors.of_look.size(); ++look) {
        if (!(errors.of_look[look] > kTolerance)) continue;
        const std::string name(shaders.shader_instances[look]->shader().name);
        if (std::ranges::count(names, name) == 0) names.push_back(name);
        worst = std::max(worst, errors.of_look[look]);
    }
    if (names.empty()) return false;
    diagnostics.report(Code::AOV_NOT_LINEAR, Location{}, fmt::format("{}", fmt::join(names, ", ")),
                       fmt::format("{:.2g}", 100 * double(worst)));
    return true;
}

namespace {

// Lights whose kernels gather what rays find.
bool is_indirect(const ShadingFrame& frame, size_t light) {
    const LightSource& source = frame.lights.lights[light];
    return calls_service(frame.shaders.shader_instances[source.look]->full, RayKind::Indirect);
}

LightLayer layer_of(const ShadingFrame& frame, const OutputPlane& plane, size_t at) {
    const size_t count = frame.lights.lights.size();
    LightLayer layer{.plane = at};
    std::vector<bool>& lights = layer.part.lights;
    lights.resize(count);
    const AovSource source = plane.source;
    if (source == AovSource::Emission) layer.kind = Kind::Emission;
    if (source == AovSource::Shadow) layer.kind = Kind::Shadow;
    layer.part.rays = source == AovSource::Indirect;
    layer.part.bare = source == AovSource::Shadow;
    for (size_t l = 0; l < count; ++l)
        if (source == AovSource::Direct || source == AovSource::Indirect || layer.part.bare)
            lights[l] = is_indirect(frame, l) == layer.part.rays;
    for (uint32_t l : plane.lights) lights[l] = true;
    return layer;
}

// Takes the layer into the sum, unless some of its light is in it.
void sum_up(LightLayer& layer, LightPart& covered) {
    if (layer.kind != Kind::Added || (layer.part.rays && covered.rays)) return;
    for (size_t l = 0; l < covered.lights.size(); ++l)
        if (layer.part.has(l) && covered.has(l)) return;
    layer.adds_up = true;
    covered.rays |= layer.part.rays;
    for (size_t l = 0; l < covered.lights.size(); ++l)
        if (layer.part.has(l)) covered.lights[l] = true;
}

// All that the sum lacks.
LightLayer rest_of(const LightPart& covered, size_t plane) {
    LightLayer rest{.plane = plane, .adds_up = true};
    rest.part.lights = covered.lights;
    rest.part.lights.flip();
    rest.part.rays = !covered.rays;
    return rest;
}

}  // namespace

std::vector<LightLayer> find_light_layers(const ShadingFrame& frame) {
    constexpr AovSource kLayers[] = {AovSource::Emission, AovSource::Direct, AovSource::Indirect,
                                     AovSource::Light, AovSource::Shadow};
    const std::vector<OutputPlane>& planes = frame.shaders.outputs;
    std::vector<LightLayer> layers;
    LightPart covered{.lights = std::vector<bool>(frame.lights.lights.size())};
    size_t rest = LightLayer::kNoPlane;
    for (size_t p = 0; p < planes.size(); ++p) {
        if (planes[p].component != 0) continue;
        if (planes[p].source == AovSource::Rest) rest = p;
        if (std::ranges::count(kLayers, planes[p].source) == 0) continue;
        layers.push_back(layer_of(frame, planes[p], p));
        sum_up(layers.back(), covered);
    }
    if (layers.empty() && rest == LightLayer::kNoPlane) return layers;
    if (std::ranges::count(layers, Kind::Emission, &LightLayer::kind) == 0)
        layers.push_back({.kind = Kind::Emission});
    LightLayer left = rest_of(covered, rest);
    if (has_plane(left) || left.part.rays || std::ranges::count(left.part.lights, true) > 0)
        layers.push_back(std::move(left));
    return layers;
}

bool start_tape(Grid& grid, const raytrace::ShadeResult& result) {
    if (grid.frame.layers.empty() || grid.depth > 0 || result.aov.empty()) return false;
    std::unique_ptr<AnswerTape>& tape = grid.memory.tape;
    if (!tape) tape = std::make_unique<AnswerTape>();
    tape->start();
    grid.tape = tape.get();
    return true;
}

void fill_light_layers(Grid& grid, const KernelRunner& kernels, const float* const Ci[3],
                       const raytrace::ShadeResult& result, LayerErrors& errors) {
    const std::vector<LightLayer>& layers = grid.frame.layers;
    const BoundKernel& bound = grid.look->full;
    const Runs runs(grid, bound, kernels);
    const Color whole{Ci[0], Ci[1], Ci[2]};
    const bool lit = grid.record_sets[0].count > 0 || !grid.tape->empty();
    Sums sums{grid, result, grid.memory.arena.allocate_span<double>(6 * grid.count()),
              lit ? runs.of({}) : whole};
    std::ranges::fill(sums.total, 0.0);
    for (const LightLayer& layer : layers) {
        if (layer.kind == Kind::Emission) {
            add_emission(sums, layer, Ci);
            continue;
        }
        const Runs own(grid, bound, kernels);
        const Color added = reaches(grid, layer.part) ? own.of(layer.part) : sums.dark;
        if (layer.kind == Kind::Added) {
            add_layer(sums, layer, added);
            continue;
        }
        LightPart shadowed = layer.part;
        shadowed.bare = false;
        add_shadow(sums, layer, added, reaches(grid, shadowed) ? own.of(shadowed) : sums.dark);
    }
    judge(sums, Ci, errors);
}

namespace {

// The volume's Ci before it: the layer's own, or none.
void load_layer(const Grid& grid, const LightLayer* layer, const raytrace::ShadeResult& result) {
    for (size_t c = 0; c < 3; ++c)
        if (float* const to = grid.columns[kColCi + c])
            for (size_t i = 0; i < padded(grid.count()); ++i)
                to[i] =
                    layer ? result.aov[layer->plane + c][grid.points[std::min(i, grid.count() - 1)]]
                          : 0.0f;
}

}  // namespace

void pass_light_layers(Grid& grid, const BoundKernel& bound, const KernelRunner& kernels,
                       const raytrace::ShadeResult& result) {
    const Runs runs(grid, bound, kernels);
    load_layer(grid, nullptr, result);
    const Color dark = runs.of({});
    for (const LightLayer& layer : grid.frame.layers) {
        if (!has_plane(layer) || layer.kind == Kind::Shadow) continue;
        const Runs own(grid, bound, kernels);
        load_layer(grid, &layer, result);
        const Color passed = own.of(layer.part);
        const bool emits = layer.kind == Kind::Emission;
        for (size_t c = 0; c < 3; ++c)
            for (size_t i = 0; i < grid.count() && passed[c]; ++i)
                result.aov[layer.plane + c][grid.points[i]] =
                    passed[c][i] - (emits ? 0.0f : dark[c][i]);
    }
}

void fill_layers_of_misses(const ShadingFrame& frame, size_t count,
                           const raytrace::ShadeResult& result) {
    if (result.aov.empty()) return;
    for (const LightLayer& layer : frame.layers)
        for (size_t c = 0; c < 3 && layer.kind == Kind::Emission && has_plane(layer); ++c)
            std::copy_n(result.Ci[c], count, result.aov[layer.plane + c]);
}

}  // namespace kinora
