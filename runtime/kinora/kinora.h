// runtime/kinora/kinora.h: a scene that is opened, listed, changed, posed and rendered.
//
//     SceneRequest request;
//     request.scene = "walker.dae";
//     request.quality = *find_quality(kDefaultQuality);
//     OpenScene scene(request);
//     raytrace::Film film;
//     if (scene.open() == SceneError::None && scene.render(0.5, film)) ...
//
// Nothing is printed: findings say what is wrong with the scene or the request. A failed CHECK of
// ourselves is INTERNAL_CHECK among them and ends the call, no more.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/kinora/contents.h"
#include "runtime/kinora/open_scene.h"
#include "runtime/kinora/scene_error.h"
#include "runtime/kinora/scene_request.h"

namespace kinora {

// What a picture took.
struct RenderedFrame {
    FrameStats stats;       // of the last try
    double dice_error = 0;  // of displaced meshes, with the scene as opened
    double redice_ms = 0;   // 0: these were fine enough
};

// One thread calls it. A scene as read is kept where it can be built again with other settings; the
// memory of its meshes is then held twice.
class OpenScene {
  public:
    enum class Keep : bool { Nothing, Source };

    explicit OpenScene(SceneRequest request, Keep keep = Keep::Source);

    // Reads the request's file, or what was its content: the scene's name then says the format
    // (.gltf, .glb, else COLLADA) where the bytes do not, and relative references begin at its
    // folder. Unreadable: no scene. Request: the clip is none of the scene's.
    SceneError read(const std::optional<std::string_view>& bytes = std::nullopt);
    // Takes a scene that somebody made, instead. `files`: what its places are in.
    SceneError take(SceneDescription made, const SourceFiles& files);
    // Builds what was read, with what was set since.
    SceneError build();
    // Both.
    SceneError open(const std::optional<std::string_view>& bytes = std::nullopt);

    // Changes of the scene as read, from the next build() on. False after an error, which is a
    // finding. Patterns and values as SceneRequest::shaders and SceneRequest::params have them.
    bool set_shader(const std::string& pattern, const std::string& shader);
    bool set_param(const std::string& target, const std::string& value);
    void set_camera(const std::string& name);
    void set_quality(const Quality& quality);

    // Sizes, samples and exposure of the frames to come, from the request. Automatic exposure makes
    // small pictures; a `stop` that is not 0 ends them, and each frame at its next rays. Called by
    // pose() and render() where it was not.
    void ready_frames(const std::atomic<int>* stop = nullptr);
    // Brings pose() to a time in seconds. False where the camera makes no
    // picture, or no scene is built.
    bool pose(double seconds);
    // Renders the scene at a time in seconds into `film` (linear, associated alpha). Displaced
    // meshes that are too coarse for the view are diced again for this frame, so that a picture
    // depends on its time alone. False where there is no whole picture; findings say why. False
    // without a scene that is built, too.
    bool render(double seconds, raytrace::Film& film, RenderedFrame* cost = nullptr,
                const raytrace::Progress* progress = nullptr);

    const SceneRequest& request() const { return request_; }
    // As read: nothing before read(), and after build() where the source is not kept.
    std::optional<ImportedScene>& imported() { return imported_; }
    bool is_built() const { return built_.scene != nullptr; }
    const Scene& scene() const { return *built_.scene; }
    Pose& pose() { return *built_.pose; }
    FrameSettings& settings() { return settings_; }
    FrameRate rate() const { return rate_; }
    Diagnostics& diagnostics() { return diagnostics_; }
    const Diagnostics& diagnostics() const { return diagnostics_; }
    // Frees what pictures are made of.
    void close() { built_ = {}; }
    // From now on build() leaves nothing of the scene as read.
    void keep(Keep keep) { keep_ = keep; }

  private:
    template <class Body, class Result>
    Result checked(Result otherwise, const Body& body);
    template <class Body>
    bool in_pose(const Body& body);
    SceneError read_source(const std::optional<std::string_view>& bytes);
    SceneError take_imported();
    SceneError build_source();
    bool pose_at(double seconds);
    bool render_at(double seconds, raytrace::Film& film, RenderedFrame& c,
                   const raytrace::Progress* progress);

    SceneRequest request_;
    Keep keep_;
    Diagnostics diagnostics_;
    std::optional<ImportedScene> imported_;
    BuiltScene built_;
    FrameSettings settings_;
    bool frames_ready_ = false;
    size_t internal_checks_ = 0;  // that failed
    FrameRate rate_;
};

}  // namespace kinora
