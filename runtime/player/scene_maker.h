// runtime/player/scene_maker.h: reads and builds scenes on a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "runtime/base/stats.h"
#include "runtime/kinora/film_reader.h"
#include "runtime/player/shown_scene.h"
#include "runtime/scene/build/instances/shader_swap.h"

namespace kinora {

// What was made so far.
struct MakerCounts {
    uint64_t scenes = 0;   // built
    uint64_t kernels = 0;  // compiled for a scene that stood
    uint64_t maps = 0;     // rendered, of a film's worlds that later ones look up
};

// Another scene on its way, or a finer one of the same.
struct Opening {
    enum class Step : uint8_t { None, Reads, Builds, Dices } step = Step::None;
    double seconds = 0;  // since it was begun
};

class SceneMaker {
  public:
    // `done` is called from the thread when a scene can be taken, or was tried in vain.
    // `hurries`: displaced meshes that take long to dice are coarse in a first scene, and a second
    // one with the dice that was asked for follows by itself. `shows_broken`: PlayerSetup's.
    SceneMaker(std::function<void()> done, bool hurries, bool shows_broken);
    ~SceneMaker();  // waits for the scene under way
    SceneMaker(const SceneMaker&) = delete;

    // Reads the file, then builds. Of several orders the last one counts. `start`: which of a
    // film's frames; nothing: the one that it begins with.
    void open(const SceneRequest& request, SceneEdits edits, bool replaces_camera,
              std::optional<StartTime> start = std::nullopt);
    // Another frame of the film that was opened last: its file is read again up to there, and what
    // stands keeps its shapes, trees and kernels. Maps that the film makes are kept, too.
    void show_frame(const SceneRequest& request, SceneEdits edits, double frame);
    // Puts these edits on the scene read last: where they change surface shaders and parameters
    // alone, the scene made last gets other kernels; else it is built anew.
    void edit(SceneEdits edits);

    // What has become of the last order: a scene, or findings without one. Null: nothing new.
    std::unique_ptr<MadeScene> take();
    MakerCounts counts() const;
    bool idle() const;     // no order, and nothing to take
    bool opening() const;  // another scene, which is not taken yet
    // Another scene that is being read or built will not be taken: the last one stays. False: none
    // was. The thread leaves it at the end of the step that it is in.
    bool cancel();
    Opening under_way() const;

  private:
    struct Order {
        std::optional<SceneRequest> open{};  // none: the scene as read
        SceneEdits edits{};
        bool replaces_camera = false;
        bool finer = false;  // the scene made last, as the request has it: gives way to any other
        std::optional<StartTime> start{};
        bool counts = false;  // the frames of a film: its file may be another one
    };
    void run();
    void order(Order order);
    std::unique_ptr<MadeScene> make(const Order& order);
    void make(const Order& order, MadeScene& made);
    bool goes_on(Opening::Step step);  // false: cancelled
    bool read(const Order& order, MadeScene& made);
    std::optional<ImportedScene> import(const Order& order, Diagnostics& diagnostics);
    int choose_frame(const FilmFrames& film, const Order& order) const;
    std::optional<ImportedScene> import_frame(const Order& order, Diagnostics& diagnostics);
    void add_film(SceneInfo& info) const;
    bool swap(const Order& order, MadeScene& made);
    void build(const Order& order, MadeScene& made);
    void pose(MadeScene& made) const;
    bool begins_coarse(const Order& order) const;
    void begin(MadeScene& made) const;
    SceneEdits with_shared_texts(SceneEdits edits) const;
    void put(std::unique_ptr<MadeScene> made);

    std::function<void()> done_;
    const bool hurries_, shows_broken_;
    mutable std::mutex mutex_;
    std::condition_variable wanted_;
    std::optional<Order> order_;
    std::deque<std::unique_ptr<MadeScene>> made_;  // a swap needs those before it
    MakerCounts counts_;
    bool working_ = false, quit_ = false;
    bool replaces_camera_ = false;  // the order in work

    bool cancelled_ = false;  // it is not wanted any more
    Opening::Step step_ = Opening::Step::None;
    Stopwatch began_;
    std::atomic<bool> overtaken_{false};  // a finer scene in work, by another order
    std::atomic<int> stop_maps_{0};       // the order in work is cancelled

    // What reading a file leaves.
    struct AsRead {
        std::optional<ImportedScene> scene;
        SceneRequest request;
        std::shared_ptr<FilmReader> film;  // null: a scene of one picture
        std::vector<std::string> files;
        SourceFiles texts;
        std::vector<BrokenShader> broken;
        std::vector<FindingText> broken_findings;
    };
    // Of the thread.
    AsRead read_;
    std::optional<ShaderSwapper> swapper_;    // of the scene built last
    std::shared_ptr<const ShownScene> last_;  // it, or what it was swapped to since
    SceneEdits built_with_;                   // its edits
    EditedShaders shaders_;
    std::shared_ptr<TextureStore> textures_;  // of the scene built last
    std::shared_ptr<const SceneInfo> info_;
    struct Dicing {
        bool coarse = false;        // the scene built last
        bool coarse_shown = false;  // the last good one
        bool is_fast = false;       // of the last one that was not coarse
    } dicing_;
    uint64_t serial_ = 0;
    int swaps_ = 0;  // so far
    std::thread thread_;
};

}  // namespace kinora
