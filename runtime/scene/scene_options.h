// runtime/scene/scene_options.h: what a scene is built for; part of what the kernels are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "anim/baked.h"
#include "jit/math/math.h"
#include "jit/target.h"
#include "raytrace/accel.h"
#include "runtime/base/math.h"
#include "runtime/description/texture_name.h"

namespace kinora {

enum class ShadowMode : uint8_t { Auto, Explicit, Off };
// Which lights shine: the scene's, and the default ones where it has none that light anything
// (Auto); only the scene's; only the default ones; both.
enum class LightSet : uint8_t { Auto, Scene, Default, Both };
enum class DisplacementMode : uint8_t { True, Bump };
// How joints are blended: by their matrices, as COLLADA has it, or by dual quaternions.
enum class SkinMethod : uint8_t { Linear, Dual };

// How a camera is put up that no file brought, and what it is to see.
struct ViewOptions {
    bool follow = false;      // it moves with the centre of what it shows
    double turn_seconds = 0;  // of a full turn about the up axis; 0: none
    double turn_start = 0;    // seconds
    double yfov = 0;          // degrees, of any camera; 0: its own
    std::optional<dvec3> from, at;
    std::string at_node;  // at the node with this path, id or name

    bool any_place() const { return follow || turn_seconds > 0 || from || at || !at_node.empty(); }
};

struct SceneOptions {
    // A view (runtime/build/views.h), or a node path or id or a camera id, the latter also behind
    // '#'; "": the first instance in document order, if it sees something of the scene.
    std::string camera;
    ViewOptions view;
    jit::math::Tier math = jit::math::Tier::Precise;
    const jit::Target* target = nullptr;  // null: the best of this CPU
    ShadowMode shadows = ShadowMode::Auto;
    LightSet lights = LightSet::Auto;
    int ray_depth = 16;  // rays that trace, gather and indirectdiffuse may hang behind each other
    int diffuse_depth = 1;  // of those, bounces of indirectdiffuse
    int split = 1;  // hits of a path where both what is reflected and what passes is followed
    int ray_limit = 1000;  // rays that a camera ray's points may shoot (docs/rays.md#budgets)
    raytrace::AccelPolicy accel;
    anim::KeyOptions keys;    // how curves through keys are followed
    bool derivatives = true;  // of shaders; false: Du, Dv and the widths of filters are 0
    TextureFilter texture_filter = TextureFilter::Anisotropic;  // the best that lookups have
    bool decode_textures = true;  // 8-bit colours from sRGB; false: --color legacy
    uint32_t light_samples = 0;   // of area lights; 0: the file's, else 16
    // The weakest lights of a point cast no shadow rays and count as shadowed, up to this share of
    // what all lights send there.
    float weak_lights = 0;
    // Classes: where opacity() leaves no channel above it, the point counts as a hole.
    float opacity_threshold = 0;
    std::vector<std::string> aovs;  // output parameters of surfaces that the picture keeps
    double frame_rate = 0;          // frames a second that option("Frame") counts; 0: the file's
    // Range played, seconds: what added cameras frame, and its views tell how fine to dice.
    double start_time = 0, end_time = 0;
    DisplacementMode displacement = DisplacementMode::True;  // Bump: only N is bent
    SkinMethod skin_method = SkinMethod::Linear;
    uint32_t influences = 0;        // the strongest that a vertex keeps; 0: all
    double dice = 2;                // length of a displaced surface's edges, pixels
    size_t dice_limit = 4'000'000;  // triangles of all displaced surfaces together
    int width = 640, height = 0;    // of the picture that dicing is for; 0: from the camera
    std::vector<std::pair<std::string, std::string>> dumps;  // filled when want_dumps
    bool want_dumps = false;
};

}  // namespace kinora
