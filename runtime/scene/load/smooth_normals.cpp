// runtime/scene/load/smooth_normals.cpp: normals by crease angle for meshes that have none.
#include "runtime/scene/load/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>
#include <tuple>

#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/load/weld.h"

namespace kinora {

namespace {

bool has_normals(const PrimitiveGroup& group) {
    return std::any_of(group.attributes.begin(), group.attributes.end(),
                       [](const auto& a) { return a.semantic == "NORMAL" && a.stride >= 3; });
}

constexpr double kSamePlane = 1e-9;  // of cosines: within 0.003 degrees

dvec3 unit_or_zero(dvec3 v) {
    double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : dvec3(0.0);
}

double corner_angle(dvec3 at, dvec3 b, dvec3 c) {
    return std::acos(std::clamp(glm::dot(unit_or_zero(b - at), unit_or_zero(c - at)), -1.0, 1.0));
}

// The corners of the groups without normals, one behind the other, and the fans they form: those
// at one position that no crease parts.
class Fans {
  public:
    Fans(const MeshDefinition& mesh, double degrees) : least_cosine_(std::cos(radians(degrees))) {
        for (size_t g = 0; g < mesh.groups.size(); ++g) {
            if (has_normals(mesh.groups[g])) continue;
            groups_.push_back(g);
            const std::vector<uint32_t>& t = mesh.groups[g].triangles;
            corners_.insert(corners_.end(), t.begin(), t.end());
        }
        parent_.resize(corners_.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        if (!corners_.empty()) find_pairs(welded(mesh.positions));
        crease(mesh.positions);
    }

    // With the vertices at these positions, too, edges are creases.
    void crease(const std::vector<dvec3>& positions) {
        std::erase_if(pairs_, [&](const Pair& pair) {
            dvec3 m = face(positions, pair.a - pair.a % 3),
                  n = face(positions, pair.b - pair.b % 3);
            bool no_area = m == dvec3(0.0) || n == dvec3(0.0);
            return !no_area && glm::dot(m, n) < least_cosine_ - kSamePlane;
        });
    }

    // Whether faces of different planes meet at an edge that is no crease.
    bool bends(const std::vector<dvec3>& positions) const {
        return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
            dvec3 m = face(positions, pair.a - pair.a % 3),
                  n = face(positions, pair.b - pair.b % 3);
            bool no_area = m == dvec3(0.0) || n == dvec3(0.0);
            return !no_area && glm::dot(m, n) < 1 - kSamePlane;
        });
    }

    // Makes the fans, once all creases are known.
    void join() {
        for (const Pair& pair : pairs_) {
            parent_[fan(pair.a)] = fan(pair.alike ? pair.b : next(pair.b));
            parent_[fan(next(pair.a))] = fan(pair.alike ? next(pair.b) : pair.b);
        }
        pairs_ = {};
    }

    bool empty() const { return corners_.empty(); }
    const std::vector<size_t>& groups() const { return groups_; }

    // The normal of each group's fans when the positions are these, and the fan of each corner.
    std::vector<VertexAttribute> normals(const MeshDefinition& mesh,
                                         const std::vector<dvec3>& positions) {
        std::vector<dvec3> sums(corners_.size(), dvec3(0.0));
        for (uint32_t c = 0; c < corners_.size(); ++c) {
            uint32_t first = c - c % 3;
            dvec3 p = positions[corners_[c]];
            sums[fan(c)] +=
                face(positions, first) * corner_angle(p, positions[corners_[first + (c + 1) % 3]],
                                                      positions[corners_[first + (c + 2) % 3]]);
        }
        std::vector<VertexAttribute> result;
        std::vector<uint32_t> number(corners_.size(), kNone);
        uint32_t first = 0;
        for (size_t g : groups_) {
            VertexAttribute& normals = result.emplace_back();
            normals.semantic = "NORMAL";
            normals.stride = 3;
            uint32_t count = uint32_t(mesh.groups[g].triangles.size());
            for (uint32_t c = first; c < first + count; ++c) {
                uint32_t at = fan(c);
                uint32_t& known = number[at];
                if (known == kNone) {
                    known = uint32_t(normals.values.size() / 3);
                    dvec3 n = unit_or_zero(sums[at]);
                    for (int k = 0; k < 3; ++k) normals.values.push_back(float(n[k]));
                }
                normals.corners.push_back(known);
            }
            for (uint32_t c = first; c < first + count; ++c) number[fan(c)] = kNone;
            first += count;
        }
        return result;
    }

  private:
    struct Edge {
        uint32_t low, high;  // welded positions
        uint32_t corner;     // where it starts, in the triangle's direction
    };
    struct Pair {
        uint32_t a, b;  // where the edge of each face starts
        bool alike;     // both start at one position
    };

    uint32_t fan(uint32_t c) {
        while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
        return c;
    }
    dvec3 face(const std::vector<dvec3>& positions, uint32_t first) const {
        dvec3 a = positions[corners_[first]];
        return unit_or_zero(
            glm::cross(positions[corners_[first + 1]] - a, positions[corners_[first + 2]] - a));
    }
    static uint32_t next(uint32_t c) { return c - c % 3 + (c + 1) % 3; }

    // By their ends, then by where they start: counted by the lower end, since a vertex has few.
    std::vector<Edge> sorted_edges(const std::vector<uint32_t>& weld) const {
        auto each = [&](auto&& f) {
            for (uint32_t c = 0; c < corners_.size(); ++c) {
                auto [low, high] = std::minmax({weld[corners_[c]], weld[corners_[next(c)]]});
                if (low != high) f(Edge{low, high, c});
            }
        };
        std::vector<uint32_t> end(weld.size() + 1, 0);  // of the edges from a lower end
        each([&](const Edge& e) { ++end[e.low + 1]; });
        std::partial_sum(end.begin(), end.end(), end.begin());
        std::vector<Edge> edges(end.back());
        each([&](const Edge& e) { edges[end[e.low]++] = e; });
        for (size_t low = 0, first = 0; low < weld.size(); first = end[low++])
            std::sort(edges.begin() + ptrdiff_t(first), edges.begin() + ptrdiff_t(end[low]),
                      [](const Edge& a, const Edge& b) {
                          return std::pair(a.high, a.corner) < std::pair(b.high, b.corner);
                      });
        return edges;
    }

    // Edges at which two faces meet, and no more.
    void find_pairs(const std::vector<uint32_t>& weld) {
        std::vector<Edge> edges = sorted_edges(weld);
        for (size_t i = 0, end; i < edges.size(); i = end) {
            for (end = i + 1; end < edges.size() && edges[end].low == edges[i].low &&
                              edges[end].high == edges[i].high;)
                ++end;
            if (end - i != 2) continue;
            uint32_t a = edges[i].corner, b = edges[i + 1].corner;
            pairs_.push_back({a, b, weld[corners_[a]] == weld[corners_[b]]});
        }
    }

    std::vector<Pair> pairs_;  // that are no creases so far
    double least_cosine_;
    std::vector<size_t> groups_;
    std::vector<uint32_t> corners_;  // positions
    std::vector<uint32_t> parent_;   // of a corner, in its fan
};

// Where the vertices of the base are when a target has its whole weight.
std::vector<dvec3> moved_by(const MorphDefinition& morph, const MeshDefinition& base,
                            const MeshDefinition& target) {
    const std::vector<dvec3>& positions = target.positions;
    const bool relative = morph.relative;
    std::vector<dvec3> moved = base.positions;
    for (size_t i = 0; i < std::min(moved.size(), positions.size()); ++i)
        moved[i] = relative ? moved[i] + positions[i] : positions[i];
    return moved;
}

// How many nodes and morphs use each mesh.
std::vector<uint32_t> uses_of_meshes(const SceneDescription& description) {
    std::vector<uint32_t> uses(description.meshes.size(), 0);
    for (const NodeDefinition& node : description.nodes)
        for (const MeshUse& use : node.meshes)
            if (use.mesh < uses.size()) ++uses[use.mesh];
    for (const MorphDefinition& morph : description.morphs)
        for (uint32_t target : morph.targets) ++uses[target];
    return uses;
}

// The targets of a morph with normals for the groups of the base that now have some. Those that
// others use too are copied.
void smooth_targets(SceneDescription& description, const MeshDefinition& base, uint32_t morph,
                    Fans& fans, const std::vector<VertexAttribute>& rest) {
    const std::vector<uint32_t> uses = uses_of_meshes(description);
    bool relative = description.morphs[morph].relative;
    for (uint32_t& target : description.morphs[morph].targets) {
        const bool own = uses[target] == 1;
        MeshDefinition copy =
            own ? std::move(description.meshes[target]) : description.meshes[target];
        copy.groups.resize(base.groups.size());
        std::vector<VertexAttribute> normals =
            fans.normals(base, moved_by(description.morphs[morph], base, copy));
        for (size_t k = 0; k < normals.size(); ++k) {
            for (size_t v = 0; relative && v < normals[k].values.size(); ++v)
                normals[k].values[v] -= rest[k].values[v];
            auto& attributes = copy.groups[fans.groups()[k]].attributes;
            std::erase_if(attributes, [](const auto& a) { return a.semantic == "NORMAL"; });
            attributes.push_back(std::move(normals[k]));
        }
        if (own) {
            description.meshes[target] = std::move(copy);
            continue;
        }
        target = uint32_t(description.meshes.size());
        description.meshes.push_back(std::move(copy));
    }
}

void add_normals(SceneDescription& description, double degrees, bool of_flat_meshes) {
    std::vector<std::set<uint32_t>> morphs(description.meshes.size());
    for (const NodeDefinition& node : description.nodes)
        for (const MeshUse& use : node.meshes)
            for (uint32_t m : morph_chain(description, use.morph)) morphs[use.mesh].insert(m);
    for (size_t m = 0; m < morphs.size(); ++m) {
        Fans fans(description.meshes[m], degrees);
        if (fans.empty()) continue;
        for (uint32_t morph : morphs[m])
            for (uint32_t target : description.morphs[morph].targets)
                fans.crease(moved_by(description.morphs[morph], description.meshes[m],
                                     description.meshes[target]));
        if (!of_flat_meshes && !fans.bends(description.meshes[m].positions)) continue;
        fans.join();
        std::vector<VertexAttribute> normals =
            fans.normals(description.meshes[m], description.meshes[m].positions);
        const MeshDefinition base = morphs[m].empty() ? MeshDefinition() : description.meshes[m];
        for (uint32_t morph : morphs[m]) smooth_targets(description, base, morph, fans, normals);
        for (size_t k = 0; k < normals.size(); ++k)
            description.meshes[m].groups[fans.groups()[k]].attributes.push_back(
                std::move(normals[k]));
    }
}

}  // namespace

void smooth_normals(SceneDescription& description, double degrees) {
    add_normals(description, degrees, false);
}

void flat_normals(SceneDescription& description) {
    add_normals(description, 0, true);
}

}  // namespace kinora
