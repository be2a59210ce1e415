// runtime/picture/frame/own_lights.cpp: scenes that their own lights leave black.
#include "runtime/picture/frame/own_lights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/picture/frame/frame.h"
#include "runtime/scene/build/defaults.h"
#include "runtime/scene/build/lights.h"
#include "runtime/scene/build/shapes/bounds.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

constexpr double kLit = 0.05;       // of what is seen: less is nearly nothing
constexpr float kDim = 0.0024f;     // light that gives white less than 8 of 255 on a display
constexpr int kSides[] = {16, 64};  // of the pictures: a coarse one shows most scenes to be lit

// COLLADA's and glTF's alone. A light in RSL is meant as it is.
bool lights_of_formats(const Scene& scene) {
    return std::ranges::all_of(scene.lights, [&](const LightSource& light) {
        const std::string& shader = scene.description->lights[light.definition].shader.shader->name;
        return shader.starts_with("collada_") || shader.starts_with("gltf_") ||
               shader == kGreyWorldShader;
    });
}

enum class Look { Black, Lit, Nothing };

Look look_of(const Scene& scene, Pose& pose, double time, int side, raytrace::Film& film,
             Diagnostics& diagnostics) {
    FrameSettings trial;
    double aspect = camera_aspect(scene).value_or(1.0);
    trial.width = std::max(int(std::lround(side * std::min(aspect, 1.0))), 1);
    trial.height = std::max(int(std::lround(side / std::max(aspect, 1.0))), 1);
    trial.integrator.samples_per_pixel = 1;
    trial.integrator.nan = raytrace::NanPolicy::Zero;
    ShadingCounters counted;
    if (!render_trial(scene, pose, time, trial, film, diagnostics, &counted) || counted.seen == 0)
        return Look::Nothing;
    bool lit = double(counted.dark) < (1 - kLit) * double(counted.seen);
    return lit ? Look::Lit : Look::Black;
}

bool is_black_throughout(const Scene& scene, Pose& pose, Diagnostics& diagnostics) {
    raytrace::Film film;
    bool black = false;
    for (double time : played_times(scene)) {
        Look look = Look::Black;
        for (int side : kSides)
            if (look != Look::Lit) look = look_of(scene, pose, time, side, film, diagnostics);
        if (look == Look::Lit) return false;
        black |= look == Look::Black;
    }
    return black;
}

// Light that is too dim to see counts as none: as what a grey world of that strength would show.
bool is_black(Scene& scene, Pose& pose, Diagnostics& diagnostics) {
    float world = std::exchange(scene.world_light, std::max(scene.world_light, kDim));
    bool black = is_black_throughout(scene, pose, diagnostics);
    scene.world_light = world;
    return black;
}

}  // namespace

bool light_black_scene(Scene& scene, Pose& pose, Diagnostics& diagnostics) {
    bool asked = scene.watch_dark > 0 && scene.options.decode_textures &&
                 has_default_lights(*scene.description) && lights_of_formats(scene);
    if (!asked || !is_black(scene, pose, diagnostics)) return true;
    const LightSource& first = scene.lights.front();
    diagnostics.report(Code::LIGHTS_BLACK, scene.description->lights[first.definition].where);
    if (!add_default_lights(scene, diagnostics)) return false;
    take_added(scene, scene.start, pose);
    pose.watch_dark = scene.watch_dark;
    pose.shading.reset();
    return true;
}

}  // namespace kinora
