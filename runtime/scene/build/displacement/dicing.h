// runtime/scene/build/displacement/dicing.h: displaced meshes split finely enough for their views.
#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "runtime/scene/build/displacement/dice_views.h"
#include "runtime/scene/build/displacement/displaced_mesh.h"
#include "runtime/scene/vertices/dice_error.h"
#include "runtime/scene/vertices/diced_mesh.h"

namespace kinora {

struct Pose;
struct SceneOptions;

class Dicing {
  public:
    // `meshes` and `views` must stay. Once `stop` (null: never) is true the result is coarse.
    Dicing(const SceneOptions& options, std::span<const DisplacedMesh> meshes,
           const DiceViews& views, const std::atomic<bool>* stop);

    // Edges as long as the options want, or longer where the limit of triangles binds. Again after
    // there are more views.
    void run();

    // After run():
    DicedMesh& made(size_t mesh) { return made_[mesh]; }
    DiceStats stats() const;  // without the time

    // Edges of what was diced, by mesh (null: nothing of it was), so that a frame can tell whether
    // they are short enough for it.
    std::vector<std::unique_ptr<WatchedEdges>> watch_edges(const SceneShapes& scene,
                                                           const Pose& start) const;

  private:
    bool stopped() const { return stop_ && *stop_; }
    double coarse_enough(double pixels);
    bool dice_to(double pixels, size_t limit);
    std::optional<DicedParts> dice_one(size_t mesh, double pixels, size_t limit) const;

    const SceneOptions& options_;
    std::span<const DisplacedMesh> meshes_;
    const DiceViews& views_;
    const std::atomic<bool>* stop_;
    std::vector<DicedParts> parts_;  // by mesh
    std::vector<DicedMesh> made_;    // by mesh, of the parts
    double pixels_ = 0;              // edge length used
};

}  // namespace kinora
