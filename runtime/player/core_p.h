// runtime/player/core_p.h: what Player holds, for the actions that its commands name.
#pragma once

#include <condition_variable>
#include <fstream>
#include <map>
#include <mutex>

#include "runtime/base/stats.h"
#include "runtime/player/files/file_watch.h"
#include "runtime/player/inspector.h"
#include "runtime/player/player.h"
#include "runtime/player/render_loop.h"
#include "runtime/player/scene_maker.h"
#include "runtime/player/thumbnails.h"

namespace kinora {

struct PlayerCore {
    explicit PlayerCore(PlayerSetup player_setup);

    PlayerSetup setup;
    PlayerState state;
    LoadState load = LoadState::Nothing;
    SceneRequest request;
    SceneEdits edits;
    std::vector<SceneEdits> undo, redo;
    // Of the scene that is shown while another one is read; none: none is.
    struct Changes {
        SceneEdits edits;
        std::vector<SceneEdits> undo, redo;
    };
    std::optional<Changes> changes_before;
    std::shared_ptr<const SceneInfo> info;
    ShaderDocument document;
    std::vector<FindingText> scene_findings, frame_findings, all_findings;
    std::shared_ptr<const Picture> kept;
    std::optional<Session> session;  // to be taken up when its scene is there
    std::optional<StartTime> start;  // likewise
    size_t film_frame = 0;           // of the film shown, that was ordered last
    dvec3 follow_from{0.0};
    SceneError error = SceneError::None;  // why the last scene could not be made
    std::ofstream record;
    double since_recorded = 0;  // seconds
    std::string taken_camera;   // as a picture showed it, for the record: `stand`'s text

    // Other threads have something new; wait_for() sleeps until then.
    std::mutex wake_mutex;
    std::condition_variable woken;
    bool typing = false;  // the last change was of the text, by keys
    std::string dragged;  // the last change was of this parameter: MATERIAL.NAME
    bool news = false;
    bool files_changed = false;     // under the same mutex
    uint64_t explained_serial = 0;  // of the scene that was explained last
    bool sized = false;             // by a command: another scene does not change it
    std::optional<std::pair<raytrace::Camera, dvec3>> answered_view;
    std::optional<ViewOrder> picked_in;  // of a click whose picture is still to come

    FileWatch watch;
    std::vector<std::string> files;           // that are watched
    std::shared_ptr<const ShownScene> shown;  // with `info`
    std::shared_ptr<TextureStore> textures;   // of the scene shown
    int images_watched = 0;
    RenderLoop loop;
    SceneMaker maker;
    Inspector inspector;
    Thumbnails thumbnails;
    TradeBoard board;
    std::optional<ViewOrder> board_view;  // of the board's pictures
    SceneEdits board_edits;
    uint64_t noted = 0;  // the picture that was put on it last

    void wake();
    // Until it is so, or for so many seconds. Takes up what comes in between.
    bool wait_for(const std::function<bool()>& reached, double seconds);
    void take_news();
    void send_order();
    ViewOrder view_order() const;
    DisplaySettings display_settings() const;
    bool idle() const {
        return maker.idle() && loop.idle() && inspector.idle() && thumbnails.idle() && board.idle();
    }
    std::optional<Awaited> ordered() const;       // see Player
    bool picture_ready(const Awaited& of) const;  // or none can be made
    std::string observe(Observable what) const;
    std::string state_json() const;  // all observables and the edits, as texts

    // What the user sees: while the scene plays, the order of the picture shown.
    ViewOrder seen_order() const;
    // Looks something up in the scene as seen_order() has it. The answer is run before this returns
    // where no clock runs; else when it comes. `poses`: Inspection's.
    void inspect(bool poses, std::function<Answer(Inspected&)> look);
    void color_pick();  // once the picture that was clicked is there
    // The camera that is moved by hand, as the picture shows it; null with a reason.
    FreeCamera* own_camera(std::string& why_not);
    void change_scene(SceneEdits edits);  // builds anew; undo brings the edits back
    // `turned`: where the turntable had the camera before; "" where it stands still.
    void watch_images();
    void record_line(const Command& command, const std::vector<std::string>& arguments,
                     const TimeState& before, const std::string& turned);
    void restore_text();
    void show_panel(const std::string& name);  // opens it, in front
    void forget_stops();                       // the files have changed, or the scene
    void explain_scene();                      // to PlayerState::explained, when the answer comes
    void keep(std::shared_ptr<const Picture> picture);  // to compare with; null: none
    void rebuild() { maker.edit(edits); }
    // Another scene from now on, as soon as it is read; with what a session says of it, or from
    // its beginning or a time on.
    void open(const SceneRequest& scene, std::optional<Session> with,
              std::optional<StartTime> start = std::nullopt);
    // The same scene, whose file or options have changed.
    void open_again() { maker.open(request, edits, false, StartTime{state.time.frame}); }
    bool shows_frame() const;  // of the film that the time is in, unless it cannot be made
    void await_frame();        // where no clock runs
    bool cancel_open();  // the scene that is being read is not wanted any more; false: none is
    void keep_scene();   // another one could not be opened
    CommandResult act(size_t row, const std::vector<std::string>& arguments);
    void note_stop();  // the picture shown, as a stop of the slider of qualities

  private:
    void follow_film();
    void begin_scene(MadeScene& made);
    void go_on_in(const SceneInfo& before, const ShownScene& seen_before);
    void take_text(const MadeScene& made);
    void order_thumbnails();
    void take_scene(std::unique_ptr<MadeScene> made);
    void take_swap(MadeScene& made);
    void merge_findings();
    void take_session(const Session& taken, MadeScene& made);
};

// The words behind a command, as its row's `arguments` say them.
class Arguments {
  public:
    explicit Arguments(const std::vector<std::string>& words) : words_(words) {}
    size_t count() const { return words_.size(); }
    bool has(size_t k) const { return k < words_.size(); }
    const std::string& text(size_t k) const { return words_[k]; }
    std::string text_or(size_t k, const std::string& otherwise) const {
        return has(k) ? words_[k] : otherwise;
    }
    double number(size_t k) const;  // checked before the action is called

  private:
    const std::vector<std::string>& words_;
};

// An action by its row's word.
using Action = CommandResult (*)(PlayerCore&, const Arguments&);
#define COMMAND(word, ...) \
    CommandResult action_##word(PlayerCore& core, const Arguments& arguments);
#include "runtime/player/commands.def"
#undef COMMAND

inline CommandResult refused(std::string why, size_t argument = 0) {
    return {false, std::move(why), argument};
}

// One of the names, or a refusal with what may have been meant.
std::string unknown_name(const std::string& kind, const std::string& word,
                         const std::vector<std::string>& known);

}  // namespace kinora
