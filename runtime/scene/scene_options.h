// runtime/scene/scene_options.h: what a scene is built for; part of what the kernels are.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "anim/baked.h"
#include "jit/target.h"
#include "raytrace/accel.h"
#include "runtime/base/math.h"
#include "runtime/scene/quality/quality.h"

namespace kinora {

// Which lights shine: the scene's, and the default ones where it has none that light anything
// (Auto); only the scene's; only the default ones; both.
enum class LightSet : uint8_t { Auto, Scene, Default, Both };

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

// Takes what printf of shaders writes, in an order that is known; empty: nobody hears it.
using PrintTo = std::function<void(std::string_view text)>;

struct SceneOptions {
    // A view (runtime/scene/build/views.h), or a node path or id or a camera id, the latter also
    // behind
    // '#'; "": the first instance in document order, if it sees something of the scene.
    std::string camera;
    ViewOptions view;
    Quality quality;                      // kernels are made for it, and frames obey it
    const jit::Target* target = nullptr;  // null: the best of this CPU
    LightSet lights = LightSet::Auto;
    uint32_t indirect = 0;                  // bounces of indirect light that every scene has
    bool background_rebuilds = true;        // of the ray tracer's trees; false: within a frame
    double low_limit = 3;                   // raytrace::AccelPolicy::low_limit
    bool decode_textures = true;            // 8-bit colours from sRGB; false: --color legacy
    std::vector<std::string> aovs;          // that the picture keeps: runtime/scene/aovs
    std::vector<std::string> light_groups;  // NAME=GLOB,...: AOVs of those lights
    bool displays = false;                  // those that the file's displays show, too
    double frame_rate = 0;  // frames a second that option("Frame") counts; 0: the file's
    // Range played, seconds: what added cameras frame, and its views tell how fine to dice.
    double start_time = 0, end_time = 0;
    std::shared_ptr<raytrace::KeptTrees> trees;  // of the pictures of one film; null: none are kept
    size_t dice_limit = 4'000'000;               // triangles of all displaced surfaces together
    int width = 640, height = 0;  // of the picture that dicing is for; 0: from the camera
    std::vector<std::pair<std::string, std::string>> dumps;  // filled when want_dumps
    bool want_dumps = false;
    PrintTo print;
};

// The settings as the ray tracer and the sampler take them.
raytrace::AccelPolicy accel_policy(const SceneOptions& options);
anim::KeyOptions key_options(const Quality& quality);

}  // namespace kinora
