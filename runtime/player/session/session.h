// runtime/player/session/session.h: all that a picture of the player depends on, to be shared as a
// .kinora file. kinora-render makes the same picture of it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/player/session/free_camera.h"
#include "runtime/player/session/scene_edits.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

struct SessionCamera {
    uint32_t index = 0;  // of the scene's cameras
    std::string name;    // of that one: it is sought by name where the index has another
    std::optional<FreeCamera> own;
    std::optional<std::pair<std::string, dvec3>> follow;  // the node, and where it was at first
};

// A picture that others are compared with, at the left of the wipe: as it was shown, whatever made
// it.
struct KeptPicture {
    Image8 image;
    double frame = 0;
};

struct Session {
    std::string scene;
    std::vector<std::string> options;  // of kinora-render, a word each: "--spp=4"
    double frame = 0;                  // a fraction while it played
    int width = 0, height = 0;         // of the picture; 0: as the options say
    double exposure = 0;               // stops above the options'
    SessionCamera camera;
    SceneEdits edits;
    // Of the player alone: open panels, and lines that set the rest.
    std::vector<std::string> panels, commands;
    std::optional<KeptPicture> kept;
};

// In the file, paths are told from its folder. An error text, or "".
std::string write_session(const std::string& file, const Session& session);
// Nothing where it is no session; `error` names file, line and column, or the member at fault.
std::optional<Session> read_session(const std::string& file, std::string& error);
// The same without its paths changed, for comparisons.
std::string session_text(const Session& session);

// Chooses the camera that the pose is seen by.
void choose_camera(const SceneCameras& scene, Pose& pose, const SessionCamera& camera);
// The camera moved by hand, at a time in seconds: where it follows a node the pose is evaluated.
PlacedCamera placed_camera(const SceneNodes& scene, Pose& pose, const FreeCamera& own,
                           const std::optional<std::pair<std::string, dvec3>>& follow,
                           double seconds);

}  // namespace kinora
