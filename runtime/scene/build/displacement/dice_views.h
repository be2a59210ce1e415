// runtime/scene/build/displacement/dice_views.h: the views that displaced meshes are diced for.
//
// How fine a mesh is diced depends on the scene, its camera, the range played and the size of the
// picture, not on which frames are rendered: a frame is the same alone and in a sequence.
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/build/displacement/closer_view.h"
#include "runtime/scene/build/displacement/displaced_mesh.h"

namespace kinora {

struct Scene;

// A camera, and where the base mesh's vertices are for it.
struct DiceView {
    raytrace::Camera camera;
    dmat4 accel_from_pose{1.0};
    std::vector<vec4> pose;  // of deforming meshes; empty: the rest positions

    bool same(const DiceView& o) const;
};

// Moves the scene through the range played and back to its start.
class DiceViews {
  public:
    // `meshes` must stay.
    DiceViews(Scene& scene, std::span<const DisplacedMesh> meshes);

    // The closest views of the range played, and one more where `closer` is not null.
    void find(const CloserView* closer);

    // Looks at what was diced (Scene::watched) from more times: the one between each two views that
    // it is most too coarse for becomes a view of its own. True where there is one. What a skin or
    // morph moves is not looked at: posing it so often would take long.
    bool refine();

    std::span<const DiceView> of(size_t mesh) const { return views_[mesh]; }

  private:
    bool set_dice_view();
    void add_now();
    void add_at(double time);
    void back_to_start();
    double coarsest_time(double from, double to);

    Scene& scene_;
    std::span<const DisplacedMesh> meshes_;
    std::vector<std::vector<DiceView>> views_;  // by mesh
    std::vector<double> times_;                 // of views; none where nothing moves
};

}  // namespace kinora
