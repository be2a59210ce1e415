// raytrace/kept_trees.h: trees that outlive the Accel that built them, for the pictures of a film
// whose scenes are built one after the other.
#pragma once

#include <memory>

namespace kinora::raytrace {

// AccelPolicy::kept of accels that follow one another. A shape of Instanced rows whose vertices and
// triangles are those of an earlier accel's shape takes its tree. Those that neither this accel nor
// the last one uses are freed. Thread-safe.
class KeptTrees {
  public:
    KeptTrees();
    ~KeptTrees();
    KeptTrees(const KeptTrees&) = delete;

    struct State;  // kept_trees_p.h
    State& state() { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

}  // namespace kinora::raytrace
