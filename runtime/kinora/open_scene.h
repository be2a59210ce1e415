// runtime/kinora/open_scene.h: from a request to a scene ready for frames.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/base/diagnostic.h"
#include "runtime/kinora/scene_request.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/picture/frame/redice.h"
#include "runtime/scene/description/import_options.h"

namespace kinora {

// A scene file read, with all that the request changes of it: what build_scene takes.
struct ImportedScene {
    SceneDescription description;
    SceneOptions options;
    FrameRate rate;
    bool clip_known = true;  // SceneRequest::clip is one of its clips, or empty
};

// "X,Y,Z"; nothing if it is not that.
std::optional<dvec3> parse_point(const std::string& text);

// Which findings of the request's scene are errors. Called before import_requested.
void judge_by(const SceneRequest& request, Diagnostics& diagnostics);

// Reads the file, or what was its content (`bytes`; the file need not be there), and changes what
// the request says. Nothing where it is no scene. Findings say why; forbidding_error() of them says
// whether a picture may be made.
std::optional<ImportedScene> import_requested(
    const SceneRequest& request, Diagnostics& diagnostics,
    const std::optional<std::string_view>& bytes = std::nullopt);

// A scene that somebody made (ImportOptions of import_options()) instead of a file's, with what the
// request changes of it.
ImportedScene import_made(const SceneRequest& request, SceneDescription made,
                          Diagnostics& diagnostics);
ImportOptions import_options(const SceneRequest& request);

struct BuiltScene {
    std::unique_ptr<Scene> scene;      // null: findings say why
    std::unique_ptr<Pose> pose;        // that its frames are made in
    std::unique_ptr<Redicer> redicer;  // null where nothing is diced
};
BuiltScene build_imported(ImportedScene imported, Diagnostics& diagnostics,
                          const BuildAgain* again = nullptr);

// Samples and filter of each pixel.
void set_sampling(raytrace::IntegratorSettings& settings, const Quality& quality);

// The picture's size, its samples, filter and so on, and its gain. Automatic exposure makes small
// pictures of the scene in `pose`; a `stop` that is not 0 ends them.
FrameSettings frame_settings(const SceneRequest& request, const Scene& scene, Pose& pose,
                             Diagnostics& diagnostics, const std::atomic<int>* stop = nullptr);

// The seed of a frame.
uint32_t frame_seed(const SceneRequest& request, int64_t frame);
// The frame that a scene which plays from `start` seconds begins with.
inline constexpr double kFurthestFrame = 1e12;  // as far as --frames goes
int64_t first_frame(FrameRate rate, double start);

// When a frame is, or what lies between two.
double seconds_of(FrameRate rate, double frame);

}  // namespace kinora
