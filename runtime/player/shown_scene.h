// runtime/player/shown_scene.h: a scene that is shown, and how it was made.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/kinora/open_scene.h"
#include "runtime/kinora/scene_error.h"
#include "runtime/player/scene_info.h"
#include "runtime/player/session/places.h"
#include "runtime/player/session/scene_edits.h"
#include "runtime/player/session/start_time.h"
#include "runtime/player/shader_document.h"

namespace kinora {

// A scene that is shown: what its pictures are made of, and what is looked up in it, by any thread.
// It never changes. An edit of its shaders makes another one, which shares the rest.
struct ShownScene {
    SceneRequest request;
    FrameRate rate;
    std::shared_ptr<const Scene> scene;
    FrameSettings settings;                        // as kinora-render has them for the request
    SourceFiles texts;                             // that locations in its shaders point into
    ColorEncoding encoding = ColorEncoding::Srgb;  // encoding_of(request), which reads the file
};

// What has become of an order.
struct MadeScene {
    std::shared_ptr<const ShownScene> shown;  // null: it could not be made; `findings` say why
    SceneEdits edits;                         // that it has
    bool swapped = false;                     // the one before with other shaders
    // Of a scene that is no swapped one:
    std::unique_ptr<Pose> pose;        // that its pictures are made in
    std::unique_ptr<Redicer> redicer;  // null where nothing is diced
    std::shared_ptr<const SceneInfo> info;
    std::unique_ptr<Diagnostics> diagnostics;  // findings to come
    std::vector<FindingText> findings;         // of reading and building
    std::vector<std::string> files;            // read: of the scene, its shaders and textures
    double build_ms = 0;                       // of edits and build, or swap
    SceneError error = SceneError::None;       // why it could not be made
    bool replaces_camera = true;               // another scene, not the same one changed
    bool finer = false;                        // the one shown, with what is displaced diced finer
    bool steps = false;                        // another frame of the film that is shown
};

FindingText finding_text(const Finding& finding, const SourceFiles& files);
// An error that no file is to blame for.
FindingText plain_finding(const std::string& code, const std::string& message);
// All that there are, and none is left.
std::vector<FindingText> take_findings(Diagnostics& diagnostics);

// `read`: the scene as read, without edits, and the texts it came from.
struct SceneRead {
    const SceneDescription& description;
    const SourceFiles& files;
};
std::shared_ptr<SceneInfo> scene_info(const Scene& scene, const SceneRead& read,
                                      const SceneRequest& request, FrameRate rate);
// The same scene with other surfaces and parameters.
std::shared_ptr<SceneInfo> swapped_info(const SceneInfo& before, const SceneDescription& edited);

}  // namespace kinora
