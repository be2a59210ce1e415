// runtime/picture/shading/dome.cpp: what lies around the scene.
//
// The light's kernel is asked for the directions of rays, as directlighting() asks it for those of
// samples. What is seen is thereby what lights.
#include "runtime/picture/shading/dome.h"

#include <algorithm>
#include <cmath>

#include "raytrace/hits.h"
#include "runtime/picture/lights/light_samples.h"
#include "runtime/picture/shading/kernel_runner.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

namespace {

constexpr float kEndless = 1e29f;  // a ray that may go so far has left the scene

const LightDefinition& definition_of(const ShadingFrame& frame, size_t light) {
    return frame.resources.description->lights[frame.lights.lights[light].definition];
}

// Whether a ray that met nothing has left the scene. The camera's end only where its view does.
bool has_left(const raytrace::HitBatch& ends, uint32_t end) {
    return ends.depth == 0 || ends.rays->tfar[ends.ray[end]] >= kEndless;
}

}  // namespace

Dome::Dome(ShadingFrame& frame, KernelRunner& kernels) : frame_(frame), kernels_(kernels) {
    frame.dome = kNone;
    for (uint32_t l = 0; l < frame.lights.lights.size(); ++l)
        if (definition_of(frame, l).surrounds) frame.dome = l;
}

bool Dome::is_behind_picture() const {
    return stands() && definition_of(frame_, frame_.dome).behind_picture;
}

bool Dome::is_seen(const RayTag& ray) const {
    if (!stands()) return false;
    const uint32_t only = frame_.insight.only_light;
    if (only != kNone && only != frame_.dome) return false;
    if (ray.type == RayType::Camera) return is_behind_picture();
    return !frame_.counts_dome[ray.counted];
}

void Dome::show(const raytrace::HitBatch& ends, const RayTag& ray, ThreadMemory& memory,
                raytrace::ShadeResult& result) {
    const ShaderInstance& look =
        *frame_.shaders.shader_instances[frame_.lights.lights[frame_.dome].look];
    Arena& arena = memory.arena;
    for (uint32_t next = 0; next < ends.count;) {
        const Arena::Mark mark = arena.mark();
        std::span<uint32_t> left = arena.allocate_span<uint32_t>(kGridPoints);
        size_t count = 0;
        for (; next < ends.count && count < kGridPoints; ++next)
            if (has_left(ends, next)) left[count++] = next;
        if (count > 0) {
            Grid lit(frame_, memory, ends, left.first(count), &look);
            kernels_.prepare(lit, ray);
            show(lit, result);
        }
        arena.release(mark);
    }
}

// The light's kernel at the ends of rays, lit from where they go.
void Dome::show(Grid& lit, raytrace::ShadeResult& result) {
    Arena& arena = lit.memory.arena;
    const size_t room = padded(lit.count());
    LightQuestion question;
    question.wish = rsl::SampleWish::Evaluate;
    question.domain = rsl::intern("sphere");
    float* along[3];
    for (int k = 0; k < 3; ++k) {
        along[k] = arena.allocate_span<float>(room).data();
        question.along[k] = along[k];
    }
    for (size_t i = 0; i < room; ++i) {
        const uint32_t end = lit.points[std::min(i, lit.count() - 1)];
        const vec3 D = frame_.camera_from_accel * triple(lit.hits.dir, end);
        for (int k = 0; k < 3; ++k) along[k][i] = D[k];
    }
    LightAnswer answer(question, lit.count(), arena);
    lit.answer = &answer;
    want_columns(lit, lit.look->full.columns);
    gather(lit);
    kernels_.run(lit.look->full, lit);
    lit.memory.counters.light_points += lit.count();
    const LightSampleRows* rows = answer.first();
    const float open = lit.hits.depth == 0 ? 1.0f : 0.0f;
    for (size_t i = 0; i < lit.count(); ++i)
        for (int k = 0; k < 3; ++k) {
            const float Cl = rows ? rows->Cl[k][i] : 0.0f;
            result.Ci[k][lit.points[i]] = std::isfinite(Cl) ? std::max(Cl, 0.0f) : 0.0f;
            result.Oi[k][lit.points[i]] = open;
        }
}

}  // namespace kinora
