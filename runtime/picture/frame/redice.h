// runtime/picture/frame/redice.h: a scene built again with displaced meshes fine enough for a view
// that comes closer than those they were diced for.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <thread>
#include <vector>

#include "runtime/scene/build/build_scene.h"
#include "runtime/scene/scene.h"

namespace kinora {

// Where edges of displaced meshes are more than so many times too long (dice_error), they are diced
// again. Never for edges that are shorter than they need be.
inline constexpr double kMostDiceError = 2;

// Whether a scene of the description may hold meshes that are diced.
bool may_dice(const SceneDescription& description, const SceneOptions& options);

// Builds scenes of one description, each diced for the range played and one view more. What comes
// out depends on the description, the options and that view alone. Between two scenes: textures
// that were read, kernels that were compiled. One thread calls it.
class Redicer {
  public:
    // The description as import left it: build_scene changes the one it is given.
    Redicer(SceneDescription description, const SceneOptions& options);
    ~Redicer();  // gives up what is under way
    Redicer(const Redicer&) = delete;

    // The scene that was built first, and the texts that findings about it point into: both are
    // shared with those to come.
    void share(const Scene& first, const SourceFiles& texts);

    // Builds here and now, with all threads. Nothing where the scene cannot be built. Findings that
    // `diagnostics` has already are not told again.
    PosedScene make(const CloserView& view, Diagnostics& diagnostics);

    // Builds on a thread of its own, up to the point where a frame at the view's time can begin,
    // while other scenes render; what was under way is given up.
    void start(const CloserView& view);
    bool running() const { return thread_.joinable(); }  // started and not taken
    bool ready() const { return done_; }                 // take() will not wait
    // What start() was asked for; waits for it. Nothing where nothing was started or could be
    // built. Throws what building threw (std::bad_alloc).
    PosedScene take(Diagnostics& diagnostics);

  private:
    PosedScene build(const CloserView& view, Diagnostics& diagnostics,
                     const std::atomic<bool>* stop) const;
    void give_up();

    SceneDescription description_;
    SceneOptions options_;
    std::shared_ptr<TextureStore> textures_;
    std::shared_ptr<PointStore> points_;
    SourceFiles texts_;

    // Of the thread; read by others once `done_` is set or it was joined.
    std::thread thread_;
    std::atomic<bool> done_{false}, stop_{false};
    PosedScene made_;
    std::unique_ptr<Diagnostics> findings_;
    std::exception_ptr failure_;
};

}  // namespace kinora
