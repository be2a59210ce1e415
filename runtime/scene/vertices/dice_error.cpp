// runtime/scene/vertices/dice_error.cpp: edges of diced meshes, watched from frame to frame.
#include "runtime/scene/vertices/dice_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shapes.h"
#include "runtime/scene/vertices/deform.h"

namespace kinora {

namespace {

constexpr size_t kMostBlocks = 16'384;

// Triangles that follow each other are taken together while their box is no longer than what so
// many lying side by side would need: dicing leaves those of one old triangle in such an order.
class BlockEdges {
  public:
    BlockEdges(std::span<const vec4> positions, const dmat3& world, size_t block)
        : positions_(positions),
          world_(world),
          block_(block),
          spread_(1.5 * std::sqrt(double(block))) {}

    void triangle(const uint32_t* corners) {
        std::array<dvec3, 3> p;
        for (size_t k = 0; k < 3; ++k) p[k] = world_ * dvec3(positions_[corners[k]]);
        dvec3 low = glm::min(p[0], glm::min(p[1], p[2]));
        dvec3 high = glm::max(p[0], glm::max(p[1], p[2]));
        double length = 0;
        std::array<uint32_t, 2> edge{};
        for (size_t k = 0; k < 3; ++k) {
            double own = glm::length(p[(k + 1) % 3] - p[k]);
            if (!(own > length)) continue;
            length = own;
            edge = {corners[k], corners[(k + 1) % 3]};
        }
        dvec3 all_low = glm::min(low, low_), all_high = glm::max(high, high_);
        double most = std::max(length, length_);
        if (count_ == block_ || (count_ && glm::length(all_high - all_low) > spread_ * most))
            flush();
        low_ = count_ ? all_low : low;
        high_ = count_ ? all_high : high;
        if (length > length_) {
            length_ = length;
            edge_ = edge;
        }
        ++count_;
    }
    void flush() {
        if (length_ > 0) edges.push_back(edge_);
        length_ = 0;
        count_ = 0;
    }

    std::vector<std::array<uint32_t, 2>> edges;  // positions

  private:
    std::span<const vec4> positions_;
    dmat3 world_;
    size_t block_;
    double spread_;
    // The block under way.
    size_t count_ = 0;
    dvec3 low_{0.0}, high_{0.0};
    double length_ = 0;
    std::array<uint32_t, 2> edge_{};
};

// Ends as sums of vertices of the base mesh, those that are needed.
void name_vertices(const Mesh& base, const DicedMesh& made,
                   std::span<const std::array<uint32_t, 2>> edges, WatchedEdges& out) {
    std::vector<uint32_t> known(base.positions.size(), kNone);
    for (const auto& edge : edges)
        for (uint32_t end : edge) {
            Stencil stencil = made.position_stencils[end];
            for (uint32_t& entry : stencil.entry) {
                uint32_t& number = known[entry];
                if (number == kNone) {
                    number = uint32_t(out.vertices.size());
                    out.vertices.push_back({{entry, entry, entry}, {1, 0, 0}});
                    out.rest.push_back(base.positions[entry]);
                }
                entry = number;
            }
            out.ends.push_back(stencil);
        }
}

double longest_rigid(const SceneExtent& scene, const Pose& pose, const WatchedEdges& watched,
                     const Shape& shape) {
    dmat4 to_accel = accel_from_rest(scene, pose, shape, watched.anchor);
    dmat3 turn(to_accel);
    dvec3 move(to_accel[3]);
    double most = 0;
    for (size_t e = 0; e + 1 < watched.rest.size(); e += 2) {
        dvec3 from = turn * dvec3(watched.rest[e]) + move;
        dvec3 to = turn * dvec3(watched.rest[e + 1]) + move;
        most = std::max(most, edge_pixels(pose.view, from, to));
    }
    return most;
}

double longest_posed(const SceneDescription& description, Pose& pose, const WatchedEdges& watched,
                     uint32_t shape, uint32_t morph, WatchedPose& stands) {
    stands.morphed.resize(watched.vertices.size());
    stands.posed.resize(watched.vertices.size());
    std::span<const vec4> rest = watched.rest;
    ShapePose& moved = pose.shapes[shape];
    if (morph != kNone) {
        morph_weights(description, pose.values, morph, moved.morph_weights);
        skin::deform(watched.morph, moved.morph_weights, stands.morphed, {});
        rest = stands.morphed;
    }
    move_by_joints(moved, watched.skin, rest, {}, stands.posed, {});
    double most = 0;
    for (size_t e = 0; e + 1 < watched.ends.size(); e += 2)
        most = std::max(most, edge_pixels(pose.view, combine(watched.ends[e], stands.posed),
                                          combine(watched.ends[e + 1], stands.posed)));
    return most;
}

}  // namespace

dmat4 accel_from_rest(const SceneExtent& scene, const Pose& pose, const Shape& shape,
                      dvec3 anchor) {
    dmat4 from_anchor(1.0), to_accel(1.0);
    from_anchor[3] = dvec4(anchor, 1.0);
    to_accel[3] = dvec4(-scene.origin, 1.0);
    return to_accel * (pose.nodes[shape.node].world * shape.conversion) * from_anchor;
}

void choose_edges(const Mesh& base, const DicedMesh& made, std::span<const uint8_t> diced,
                  const dmat3& world, bool deforms, size_t triangles, WatchedEdges& out) {
    BlockEdges blocks(made.mesh.positions, world, triangles / kMostBlocks + 1);
    for (size_t g = 0; g < made.mesh.groups.size(); ++g) {
        if (!diced[g]) continue;
        const std::vector<uint32_t>& corners = made.mesh.groups[g].triangles;
        for (size_t c = 0; c + 2 < corners.size(); c += 3) blocks.triangle(&corners[c]);
        blocks.flush();
    }
    if (deforms) return name_vertices(base, made, blocks.edges, out);
    for (const auto& edge : blocks.edges)
        for (uint32_t end : edge) out.rest.push_back(made.mesh.positions[end]);
}

double dice_error(const SceneDescription& description, const SceneShapes& scene, Pose& pose) {
    double most = 0;
    for (size_t w = 0; w < scene.watched.size(); ++w) {
        const WatchedEdges& watched = *scene.watched[w];
        const bool deforms = watched.deforms();
        if (!watched.ends.empty() && !deforms) continue;  // no scene yet
        for (uint32_t h : watched.shapes) {
            const Shape& shape = scene.shapes[h];
            most = std::max(most, deforms ? longest_posed(description, pose, watched, h,
                                                          shape.morph, pose.watched[w])
                                          : longest_rigid(scene, pose, watched, shape));
        }
    }
    return scene.watched.empty() ? 0 : most / (kLongestEdge * scene.dice.pixels);
}

}  // namespace kinora
