// runtime/picture/frame/frame.h: a time to a picture.
#pragma once

#include <array>
#include <atomic>
#include <functional>

#include "raytrace/film.h"
#include "runtime/base/stage_clock.h"
#include "runtime/picture/shading/frame/insight.h"
#include "runtime/picture/shading/shading.h"

namespace kinora {

struct Pose;
struct Scene;

// What one frame cost; times in ms of wall clock.
struct FrameStats {
    double animate = 0;
    double skin = 0;      // transformations and displacements included
    double displace = 0;  // of that, theirs
    double refit = 0;
    double total = 0;
    std::array<double, kStageCount> stages{};  // sum to the total; of threads, the mean
    uint64_t rays = 0;                         // camera, shadow and reflection rays
    raytrace::TraceCounters camera_rays;       // of those, the camera's and their continuations
    raytrace::TraceCounters shader_rays;       // and those of lights and shaders
    uint64_t shading_points = 0;
    uint64_t light_points = 0;  // of the kernels of lights
    uint64_t vertices = 0;      // of morphs, skins and displacements that were moved
    uint64_t columns = 0;       // floats gathered for kernels
    uint64_t non_finite = 0;
    int refits = 0, rebuilds = 0;
    int kept_trees = 0;        // built for earlier pictures of a film
    size_t rows_compared = 0;  // of the ray tracer, with those of the frame before
    double dice_error = 0;     // runtime/scene/vertices/dice_error.h
    bool too_coarse = false;   // the frame was let go for that
};

struct PlacedCamera;  // runtime/scene/camera.h

struct FrameSettings {
    int width = 640, height = 360;
    double shutter = 0;                      // seconds
    double most_dice_error = 0;              // 0: any
    double gain = 1;                         // of the picture's colours: 2 ^ exposure
    double gamma = 1;                        // colours, when multiplied, to the power 1 / gamma
    const std::atomic<int>* stop = nullptr;  // not 0: the frame is let go at the next rays
    const PlacedCamera* camera = nullptr;    // instead of the scene's
    ShadingInsight insight = {};             // its costs are started by the frame
    // Not 0: the film holds so many rows at a time, a multiple of the integrator's tile, and
    // `on_band` gets each band from the top; false from it stops the frame. The picture has the
    // same bits.
    int band_rows = 0;
    std::function<bool(const raytrace::Film& band)> on_band = {};
    raytrace::IntegratorSettings integrator;
};

// Renders the scene at a time into the film (linear, associated alpha), in a pose that is new or
// has stood at another time. Several poses of a scene may be rendered at once, each by one thread.
// Findings: camera errors, shader faults, non-finite results. False when the camera makes no
// picture, displaced meshes are too coarse for it, or `progress` or `stop` stopped the frame.
// Allocates nothing once no new kernel or texture is met.
bool render_frame(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                  raytrace::Film& film, FrameStats& stats, Diagnostics& diagnostics,
                  const raytrace::Progress* progress = nullptr);

// The same picture for its brightness alone, before any of the scene's imager: what shaders print
// and bake is dropped, and so is what they do wrong, which the frames tell. `shading`: what was
// counted.
bool render_trial(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                  raytrace::Film& film, Diagnostics& diagnostics,
                  ShadingCounters* shading = nullptr);

// What render_frame does before the first ray: brings the pose to the time. False when the
// camera makes no picture or displaced meshes are too coarse for it.
bool pose_frame(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                FrameStats& stats, Diagnostics& diagnostics);

}  // namespace kinora
