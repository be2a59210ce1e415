// runtime/picture/shading/lighting/lamp_probe.cpp: samples of a light by area tell the variance of
// both kinds: the mean of Cl^2 by area, and by angle that of Cl^2 times the ratio of the densities.
// A direction that counts the near and the far side of a sphere has at most twice the sum of both.
#include "runtime/picture/shading/lighting/lamp_probe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"
#include "runtime/picture/lights/solid_angle.h"
#include "runtime/picture/shading/kernel_runner.h"
#include "runtime/picture/shading/lighting/lamps.h"

namespace kinora {

namespace {

constexpr size_t kPlaces = 8, kOfPlace = 32, kProbeSamples = kPlaces * kOfPlace;
constexpr double kSame = 1e-3;  // of the variances: rounding decides nothing

// Points about a lamp, off its planes of symmetry and about as far as it is wide.
dvec3 place_about(const LampShape& shape, size_t k) {
    const bool sphere = shape.kind == LampShape::Kind::Sphere;
    const dvec3 size =
        sphere ? dvec3(shape.radius)
               : 0.5 * dvec3(shape.side[0], shape.side[1], std::max(shape.side[0], shape.side[1]));
    const dvec3 middle =
        sphere ? shape.center : shape.corner + size.x * shape.axis[0] + size.y * shape.axis[1];
    const dvec3 axes[3] = {sphere ? dvec3(1, 0, 0) : shape.axis[0],
                           sphere ? dvec3(0, 1, 0) : shape.axis[1],
                           sphere ? dvec3(0, 0, 1) : shape.axis[2]};
    const dvec3 off = size * dvec3(k & 1 ? 1.1 : -0.9, k & 2 ? 1.3 : -0.8, k & 4 ? 1.2 : -1.0);
    return middle + off.x * axes[0] + off.y * axes[1] + off.z * axes[2];
}

// Samples of the mesh by area, each lit from the place of its turn.
struct Probes {
    Probes(Arena& arena, const AreaLight& light, const raytrace::Accel& accel)
        : samples(arena, kProbeSamples, light.surfaces[0]),
          numbers(arena.allocate_span<uint32_t>(kProbeSamples)) {
        float* org[3];
        for (size_t c = 0; c < 3; ++c) {
            org[c] = arena.allocate_span<float>(padded(kProbeSamples)).data();
            samples.hits.org[c] = org[c];
        }
        for (uint32_t i = 0; i < kProbeSamples; ++i) {
            numbers[i] = i;
            const LampPlace place = place_on(light, vec2(raytrace::stratified_sample(i, 0)));
            samples.primitive[i] = place.triangle;
            samples.u[i] = place.uv.x;
            samples.v[i] = place.uv.y;
            for (int c = 0; c < 3; ++c) org[c][i] = float(place_about(light.shape, i % kPlaces)[c]);
        }
        samples.find_points(accel);
    }
    LightSamples samples;
    std::span<uint32_t> numbers;
};

// Sums of Cl^2 of both kinds of samples.
struct Squares {
    double by_area = 0, by_angle = 0;
};

Squares squares_of(const AreaLight& light, const LightSamples& samples,
                   const LightOutputs& statement, std::span<float* const> out) {
    Squares sum;
    const bool sphere = light.shape.kind == LampShape::Kind::Sphere;
    const double sides = sphere && !light.hides_far ? 2 : 1;
    for (size_t i = 0; i < kProbeSamples; ++i) {
        const dvec3 P(triple(samples.hits.org, i)), Ng(triple(samples.hits.Ng, i));
        const dvec3 L = dvec3(triple(samples.hits.P, i)) - P;
        const double square = glm::dot(L, L), across = std::abs(glm::dot(Ng, L));
        const bool hidden = sphere && light.hides_far && glm::dot(Ng, L) > 0;
        const double angle = SolidAngle(light.shape, P).density();
        if (hidden || !(across > 0) || !(angle > 0)) continue;
        if (statement.lit >= 0 && jit::bits_of(out[size_t(statement.lit)][i]) == 0) continue;
        double strength = 0;
        for (int output : statement.Cl)
            if (output >= 0)
                strength = std::max(strength, std::abs(double(out[size_t(output)][i])));
        if (!std::isfinite(strength)) continue;
        const double even = square * std::sqrt(square) / (across * double(light.below.back()));
        sum.by_area += strength * strength;
        sum.by_angle += strength * strength * sides * even / angle;
    }
    return sum;
}

}  // namespace

bool suits_by_angle(const ShadingFrame& frame, const KernelRunner& kernels, ThreadMemory& memory,
                    const AreaLight& light, size_t number,
                    std::span<const LightOutputs> statements) {
    if (light.shape.kind == LampShape::Kind::Other || !light.directed) return false;
    if (light.emits) return true;  // one radiance all over, or a texture
    const Arena::Mark mark = memory.arena.mark();
    const Probes probes(memory.arena, light, frame.pose.accel);
    Grid lit(frame, memory, probes.samples.hits, probes.numbers,
             frame.shaders.shader_instances[frame.lights.lights[number].look].get());
    kernels.prepare(lit, {});
    fill_light_columns(lit, frame);
    const std::span<float*> out = kernels.run_in_the_dark(lit);
    Squares sum;
    for (const LightOutputs& statement : statements) {
        const Squares of_one = squares_of(light, probes.samples, statement, out);
        sum.by_area += of_one.by_area;
        sum.by_angle += of_one.by_angle;
    }
    memory.arena.release(mark);
    return sum.by_angle <= sum.by_area * (1 + kSame);
}

}  // namespace kinora
