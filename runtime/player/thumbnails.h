// runtime/player/thumbnails.h: our shaders, each on the selected object: small pictures made on a
// thread of their own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runtime/player/shown_scene.h"
#include "runtime/player/view_order.h"

namespace kinora {

struct Thumbnail {
    std::string shader;
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;  // as Picture::rgba
};

// What they show. They are made anew for another scene, material or object, not while these are
// edited or the camera moves.
struct ThumbnailOrder {
    std::shared_ptr<const ShownScene> shown;
    std::string scene;     // its file
    std::string material;  // of the scene's description, by id
    std::string node;      // path of the object, which stands there alone
    ViewOrder view;        // the way that it is looked at, and when

    bool same(const ThumbnailOrder& other) const;
};

// Our surface shaders, without those that importers alone put on.
std::vector<std::string> shaders_to_choose();

// The edits, with that material wearing another text: what was said of its parameters is dropped.
SceneEdits edits_with_text(SceneEdits edits, const SceneEdits::Text& text);

class Thumbnails {
  public:
    // `wake` is called from the thread after each of them.
    explicit Thumbnails(std::function<void()> wake);
    ~Thumbnails();
    Thumbnails(const Thumbnails&) = delete;

    void order(const ThumbnailOrder& order);                     // the same one as before: nothing
    void forget();                                               // nobody looks any more
    std::vector<std::shared_ptr<const Thumbnail>> made() const;  // so far
    bool idle() const;

  private:
    void run();
    void make(const ThumbnailOrder& order);
    bool make(const ThumbnailOrder& order, const std::string& shader, Thumbnail& to) const;

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable wanted_;
    std::optional<ThumbnailOrder> order_, known_;  // to be made; the last one
    std::vector<std::shared_ptr<const Thumbnail>> made_;
    bool working_ = false, quit_ = false;
    std::atomic<int> stop_{0};
    std::thread thread_;
};

}  // namespace kinora
