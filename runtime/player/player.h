// runtime/player/player.h: a scene that plays. The window and scripts drive it by the same
// commands.
//
// One thread calls the functions below; none of them waits for a picture unless its name says so.
// Pictures are made on threads of its own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/kinora/scene_error.h"
#include "runtime/kinora/scene_request.h"
#include "runtime/player/commands.h"
#include "runtime/player/picture/picture.h"
#include "runtime/player/scene_info.h"
#include "runtime/player/session/session.h"
#include "runtime/player/session/start_time.h"
#include "runtime/player/shader_document.h"
#include "runtime/player/state.h"

namespace kinora {

// A scene as a session has it.
struct OpenedSession {
    SceneRequest request;
    Session session;
};

struct PlayerSetup {
    // false: time moves by advance() alone, every picture has all pixels, and no measured time
    // decides anything: the same script gives the same pictures.
    bool real_time = true;
    bool watch_files = true;  // opens anew what changes on the disk
    // Called from other threads when there is something new to show. It must not wait.
    std::function<void()> wake = nullptr;
    // Reads a .kinora file and its options; nothing and a message where it cannot.
    std::function<std::optional<OpenedSession>(const std::string& file, std::string& error)>
        read_session = nullptr;
    // A scene whose embedded shaders have errors is shown without these, to be mended in the
    // editor.
    bool shows_broken = false;
};

enum class LoadState : uint8_t { Nothing, Loading, Ready, Failed };

struct PlayerCore;   // core_p.h
struct Thumbnail;    // thumbnails.h
struct MakerCounts;  // scene_maker.h
struct Opening;      // scene_maker.h

// What was done up to a moment: pictures that were ordered, clicks and other questions.
struct Awaited {
    uint64_t pictures = 0, questions = 0;
};

class Player {
  public:
    explicit Player(PlayerSetup setup = {});
    ~Player();
    Player(const Player&) = delete;

    // Begins to read a scene; without a name, none: its options are those of the first one that
    // the command `open` names. The one shown stays until it is there. Options as kinora-render's.
    // `start`: when it begins, whatever the session says.
    void open(const SceneRequest& request, std::optional<Session> session = std::nullopt,
              std::optional<StartTime> start = std::nullopt);
    LoadState load_state() const;
    Opening opening() const;  // another scene that is being read

    // The only way to any action.
    CommandResult run(std::string_view word, const std::vector<std::string>& arguments);
    CommandResult run_line(std::string_view line);

    // Seconds went by: time goes on where it plays, and what other threads have finished is taken
    // up. A window calls it in each turn of its loop, also with 0.
    void advance(double seconds);

    // What is shown, and what there is to show.
    const PlayerState& state() const;
    std::shared_ptr<const Picture> picture() const;  // null before the first
    std::shared_ptr<const SceneInfo> scene() const;  // null before the first
    const ShaderDocument& shader() const;
    const std::vector<FindingText>& findings() const;  // of the scene and of the last pictures
    // Our shaders on the selected object, while the panel `library` is open; those made so far.
    std::vector<std::shared_ptr<const Thumbnail>> thumbnails() const;
    std::vector<StageTimes> stage_times() const;  // of the last 120 frames, the newest last
    std::string observe(Observable what) const;   // changes when what is observed does

    // Nothing is left to do: the picture is refined, or cannot be made.
    bool idle() const;
    // Stands for all that was done up to now; none while scenes or shaders are still being made.
    std::optional<Awaited> ordered() const;
    // Whether there is a picture of that or of something later, refined or not, and what was
    // clicked by then is known.
    bool picture_ready(const Awaited& of) const;
    bool real_time() const;
    uint64_t frames_rendered() const;  // begun, so far
    MakerCounts made() const;

    // For scripts and tests: until the scene is there or failed; until idle(). False after so many
    // seconds.
    bool wait_loaded(double seconds);
    bool wait_idle(double seconds);
    bool wait_picture(double seconds);  // until picture_ready() of what was done up to now

    // Each command that was done, as lines of a script, with the time that went by between them.
    // False where the file cannot be written.
    bool record_to(const std::string& file);

    SceneError error() const;  // why the last scene could not be shown

  private:
    std::unique_ptr<PlayerCore> core_;
};

}  // namespace kinora
