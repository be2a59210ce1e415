// runtime/picture/shading/frame/frame.h: the frame that is shaded, and each thread's memory for
// it.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "raytrace/wavefront.h"
#include "runtime/base/arena.h"
#include "runtime/picture/shading/frame/answer_tape.h"
#include "runtime/picture/shading/frame/insight.h"
#include "runtime/picture/shading/frame/light_layers.h"
#include "runtime/scene/lights.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/resources.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/picture_points.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/shapes.h"

namespace kinora {

struct Scene;

// How often a point may ask for the lights at points of its own, some 8 KB each time: a march may,
// a loop that does not end must not take all memory.
inline constexpr uint32_t kMostLightQuestions = 8192;

struct ShadingCounters {
    raytrace::TraceCounters trace;  // shadow and reflection rays
    uint64_t points = 0;            // surface kernels
    uint64_t light_points = 0;      // light kernels
    uint64_t opacity_points = 0;    // opacity kernels
    uint64_t columns = 0;           // floats gathered for kernels
    uint64_t too_deep = 0;          // rays that met more surfaces than are seen through
    uint64_t unlit = 0;             // questions for lights beyond kMostLightQuestions
    uint64_t out_of_rays = 0;       // points that asked for more rays than they may shoot
    uint64_t thinned = 0;           // points that took fewer samples than they asked for
    uint64_t kernel_points = 0, kernel_lanes = 0;  // of all launches; lanes in whole registers
    uint64_t seen = 0, dark = 0;  // hits of the camera that show anything; of those, unlit ones
    void operator+=(const ShadingCounters& o);
};

// What is the same for all that is shaded in a frame. Set by Shading before the first hit.
struct ShadingFrame : EyeSpace {
    ShadingFrame(const Scene& s, const Pose& p);

    const Scene& scene;  // for what shaders look up; all else is read of its parts
    const SceneResources& resources;
    const SceneNodes& nodes;
    const SceneShapes& shapes;
    const SceneLights& lights;
    const SceneShaders& shaders;
    const Quality& quality;  // the scene's
    const Pose& pose;
    std::vector<InstanceFrame> instances = {};  // of Scene::shader_instances
    uint32_t seed = 0;
    int max_layers = 256;    // surfaces that a ray sees through
    bool footprints = true;  // some shader reads those of hits
    bool any_transparent = false;
    bool lights_shoot = false;  // some light's kernel shoots rays
    uint32_t dome = kNone;      // of Scene::lights: what rays see that leave the scene
    // Of each look: how often light is reflected that its kernel gathers by indirect rays.
    std::vector<uint32_t> bounces;
    // Of each look: which lights that rays can see light it, a number for each set; 0: none. Those
    // that its rays of diffuse light do not count again, and its rays for specular samples.
    std::vector<uint32_t> counted = {}, counted_specular = {};
    std::vector<bool> counts_dome = {};  // of each set
    // Where rays that meet nothing end: the camera's far clip where its file has one, else the far
    // side of the scene: the eye's distance from the centre plus the diagonal.
    float far_distance = 0;
    float miss_distance = 0;  // the same where some volume or the dome lies there, else 0
    // Of each surface, where an AOV has them: crypto_id() of its node's path and its material.
    std::vector<float> object_crypto = {}, material_crypto = {};
    bool relit = false;                   // an AOV is of albedo
    std::vector<LightLayer> layers = {};  // AOVs of light; none: no kernel runs for them
    bool layers_read_bare_light = false;
    const std::atomic<int>* stop = nullptr;
    ShadingInsight insight = {};

    bool stopped() const { return stop && stop->load(std::memory_order_relaxed) != 0; }
};

// One thread's memory. Nested shading (reflections, opacity of shadow rays) takes its rays and hits
// by depth, so that an outer wavefront is never overwritten.
struct ThreadMemory {
    explicit ThreadMemory(size_t n) : number(n) {}

    struct Level {
        raytrace::RayBatch rays;
        raytrace::HitStore hits;
    };
    size_t number;           // of the thread
    bool footprints = true;  // ShadingFrame::footprints
    Arena arena{1 << 20};
    ShadingCounters counters;
    std::vector<std::unique_ptr<Level>> levels;
    size_t level = 0;                  // levels in use
    std::unique_ptr<AnswerTape> tape;  // for layers of light: of one grid at a time
    LayerErrors layer_errors;
};
using ThreadMemories = std::vector<std::unique_ptr<ThreadMemory>>;

// Takes the next level of nested wavefronts for its scope.
class NestedWavefront {
  public:
    explicit NestedWavefront(ThreadMemory& memory) : memory_(memory) {
        if (memory.level == memory.levels.size())
            memory.levels.push_back(std::make_unique<ThreadMemory::Level>());
        level_ = memory.levels[memory.level++].get();
        level_->rays.spreads = memory.footprints;
    }
    ~NestedWavefront() { --memory_.level; }
    NestedWavefront(const NestedWavefront&) = delete;
    ThreadMemory::Level* operator->() const { return level_; }

  private:
    ThreadMemory& memory_;
    ThreadMemory::Level* level_;
};

}  // namespace kinora
