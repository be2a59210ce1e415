// raytrace/kept_trees_p.h: the tree of a shape, and those that later accels may take.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "raytrace/embree_p.h"
#include "raytrace/kept_trees.h"

namespace kinora::raytrace {

// A mesh alone in its scene, which instances are of.
struct ShapeTree {
    float scale = 1;  // Embree's vertices from those of its space
    EmbreeScene scene;
    EmbreeMesh mesh;
    std::vector<uint32_t> kept;  // without_untraceable() of the vertices that the tree was built of
    vec3 low{0.0f}, high{0.0f};  // the scene's box; low above high: nothing in it is traceable
    // What a kept tree reads, of its own.
    std::vector<vec4> positions;
    std::vector<uint32_t> triangles;
};

// What decides a tree.
struct ShapeSource {
    std::span<const vec4> positions;
    std::span<const uint32_t> triangles;
    float scale = 1;
    bool robust = true, filtered = true;
};

struct KeptTrees::State {
    struct Entry {
        std::shared_ptr<ShapeTree> tree;
        bool robust, filtered;
        uint64_t used;  // the accel, by its number
    };

    // An accel begins: drops what the last two did not use.
    void begin();
    // Null: there is none.
    std::shared_ptr<ShapeTree> find(const ShapeSource& source);
    void keep(const ShapeSource& source, std::shared_ptr<ShapeTree> tree);

  private:
    std::mutex mutex_;
    std::unordered_multimap<uint64_t, Entry> entries_;  // by a hash of the buffers
    uint64_t accel_ = 0;
};

}  // namespace kinora::raytrace
