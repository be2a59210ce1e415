// runtime/play/scene_maker.h: reads and builds scenes on a thread of its own.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "runtime/play/shown_scene.h"

namespace kinora {

class SceneMaker {
  public:
    // `done` is called from the thread when a scene can be taken, or was tried in vain.
    explicit SceneMaker(std::function<void()> done);
    ~SceneMaker();  // waits for the scene under way
    SceneMaker(const SceneMaker&) = delete;

    // Reads the file, then builds. Of several orders the last one counts.
    void open(const SceneRequest& request, SceneEdits edits, bool replaces_camera);
    // Builds the scene read last anew, with these edits.
    void edit(SceneEdits edits);

    // What has become of the last order: a scene, or findings without one. Null: nothing new.
    std::unique_ptr<ShownScene> take();
    bool idle() const;     // no order, and nothing to take
    bool opening() const;  // another scene, which is not taken yet

  private:
    struct Order {
        std::optional<SceneRequest> open;  // none: the scene as read
        SceneEdits edits;
        bool replaces_camera = false;
    };
    void run();
    std::unique_ptr<ShownScene> make(const Order& order);
    bool read(const SceneRequest& request, ShownScene& shown);
    void build(const Order& order, ShownScene& shown);

    std::function<void()> done_;
    mutable std::mutex mutex_;
    std::condition_variable wanted_;
    std::optional<Order> order_;
    std::unique_ptr<ShownScene> made_;
    bool working_ = false, quit_ = false;
    bool replaces_camera_ = false;  // the order in work

    // Of the thread.
    std::optional<ImportedScene> base_;  // as read
    SceneRequest request_;
    std::vector<std::string> files_;
    SourceFiles texts_;  // that `base_` was read from
    uint64_t serial_ = 0;
    std::thread thread_;
};

}  // namespace kinora
