// runtime/play/shown_scene.h: a scene that is ready to be shown, and the edits it was built with.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/build/instances/shader_swap.h"
#include "runtime/play/scene_info.h"
#include "runtime/play/session/places.h"
#include "runtime/play/session/scene_edits.h"
#include "runtime/play/shader_document.h"
#include "runtime/play/view_order.h"
#include "runtime/programs/open/open_scene.h"

namespace kinora {

// Where only shaders and their parameters have changed: what brings the scene that is shown there.
struct SwappedShaders {
    ShaderSwap swap;
    SourceFiles files;  // that findings of later pictures are in
};

struct ShownScene {
    SceneRequest request;
    SceneEdits edits;
    FrameRate rate;
    std::unique_ptr<Scene> scene;           // null: it could not be made; `findings` say why
    std::unique_ptr<Pose> pose;             // of the scene, that its pictures are made in
    std::optional<SwappedShaders> swapped;  // in place of a scene
    std::unique_ptr<Redicer> redicer;       // null where nothing is diced
    PosedScene closer;                      // with displaced meshes diced for a nearer view
    std::optional<ViewOrder> closer_view;  // the picture that it was diced for; none: a smaller one
    bool shows_closer = false;             // which made the last picture
    FrameSettings settings;                // as kinora-render has them for the request
    std::shared_ptr<const SceneInfo> info;
    std::unique_ptr<Diagnostics> diagnostics;  // findings to come
    std::vector<FindingText> findings;         // of reading and building
    std::vector<std::string> files;            // read: of the scene, its shaders and textures
    double build_ms = 0;                       // of edits and build, or swap
    int exit_code = 0;                         // kinora-render's, where it could not be made
    bool replaces_camera = true;               // another scene, not the same one changed
    bool finer = false;                        // the one shown, with what is displaced diced finer

    // What made the last picture.
    const Scene& seen() const { return shows_closer ? *closer.scene : *scene; }
    Pose& seen_pose() const { return shows_closer ? *closer.pose : *pose; }
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
