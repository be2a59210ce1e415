// runtime/vertices/diced_mesh.cpp: vertices, wedges and attributes of diced triangles.
#include "runtime/vertices/diced_mesh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <glm/geometric.hpp>

#include "runtime/description/pair_numbers.h"

namespace kinora {

namespace {

using Corners = std::array<uint32_t, 3>;

// Numbers of the points that dicing puts on edges: both triangles at an edge find the same.
class EdgePoints {
  public:
    uint32_t number(const Corners& ends, DicePoint at, uint32_t next) {
        int k = 0;  // the corner that the edge leaves out
        while (at.weight(k) != 0) ++k;
        int a = (k + 1) % 3, b = (k + 2) % 3;
        if (ends[size_t(a)] > ends[size_t(b)]) std::swap(a, b);
        uint32_t edge = edges_.number(ends[size_t(a)], ends[size_t(b)], edge_count_);
        edge_count_ += edge == edge_count_;
        return points_.number(edge, at.weight(b), next);
    }

  private:
    PairNumbers edges_, points_;
    uint32_t edge_count_ = 0;
};

int zero_weights(DicePoint p) {
    return (p.weight(0) == 0) + (p.weight(1) == 0) + (p.weight(2) == 0);
}
int corner_of(DicePoint p) {  // of a point with two zero weights
    return p.i ? 1 : p.j ? 2 : 0;
}

Stencil stencil(const Corners& entries, DicePoint at) {
    Stencil s;
    for (int k = 0; k < 3; ++k) {
        s.entry[k] = entries[size_t(k)];
        s.weight[k] = float(at.weight(k)) / float(kDiceOne);  // 20 bits: exact
    }
    return s;
}

// A wedge of the base mesh for each corner: equal where all that is known of the corners is equal.
std::vector<uint32_t> number_wedges(const MeshGroup& group) {
    std::vector<uint32_t> wedges = group.flat() ? group.triangles : group.normal_corners;
    for (const VertexAttribute& attribute : group.definition->attributes) {
        if (attribute.semantic == "NORMAL") continue;
        PairNumbers numbers(wedges.size() / 2);
        uint32_t count = 0;
        for (size_t c = 0; c < wedges.size(); ++c) {
            wedges[c] = numbers.number(wedges[c], attribute.corners[c], count);
            count += wedges[c] == count;
        }
    }
    return wedges;
}

bool has_texcoord(const PrimitiveGroup& group) {
    return std::any_of(group.attributes.begin(), group.attributes.end(),
                       [](const auto& a) { return a.semantic == "TEXCOORD" && a.stride >= 2; });
}

// Texture coordinates where a file has none: the barycentrics of each triangle.
VertexAttribute barycentric_texcoord(size_t corners) {
    VertexAttribute a;
    a.semantic = "TEXCOORD";
    a.stride = 2;
    a.values = {0, 0, 1, 0, 0, 1};
    for (size_t c = 0; c < corners; ++c) a.corners.push_back(uint32_t(c % 3));
    return a;
}

// One group of the base mesh to its diced one.
class GroupDicer {
  public:
    GroupDicer(const Mesh& base, const MeshGroup& from, bool moved, EdgePoints& edge_positions,
               DicedMesh& out)
        : base_(base),
          from_(from),
          of_faces_(moved && from.flat()),
          edge_positions_(edge_positions),
          out_(out) {
        group_.flat = from.flat();
        to_ = std::make_unique<PrimitiveGroup>();
        to_->symbol = from.symbol;
        for (const VertexAttribute& a : from.definition->attributes)
            if (a.semantic != "NORMAL") sources_.push_back(&a);
        bool barycentric = !has_texcoord(*from.definition);
        if (barycentric) {
            barycentrics_ = barycentric_texcoord(from.triangles.size());
            sources_.push_back(&barycentrics_);
        }
        if (barycentric || of_faces_) {  // every triangle has wedges of its own
            for (uint32_t c = 0; c < from.triangles.size(); ++c) base_wedges_.push_back(c);
        } else {
            base_wedges_ = number_wedges(from);
        }
        for (const VertexAttribute* a : sources_) {
            VertexAttribute& made = to_->attributes.emplace_back();
            made.semantic = a->semantic;
            made.set = a->set;
            made.stride = a->stride;
        }
        normal_of_.assign(base.normals.size(), kNone);
        wedge_of_.assign(from.triangles.size(), kNone);
    }

    void triangle(size_t t, const DicedTriangle& diced) {
        static const DicedTriangle kItself = {{{0, 0}, {kDiceOne, 0}, {0, kDiceOne}}, {0, 1, 2}};
        const DicedTriangle& d = diced.triangles.empty() ? kItself : diced;
        for (size_t k = 0; k < 3; ++k) {
            corner_[k] = 3 * t + k;
            positions_[k] = from_.triangles[corner_[k]];
            if (!from_.flat()) normals_[k] = from_.normal_corners[corner_[k]];
            wedges_[k] = base_wedges_[corner_[k]];
        }
        if (of_faces_) face_ = face_normal();
        numbers_.clear();
        for (DicePoint p : d.points) numbers_.push_back(wedge(p));
        for (uint32_t p : d.triangles) group_.corners.push_back(numbers_[p]);
    }

    void finish() {
        MeshGroup& made = out_.mesh.groups.emplace_back();
        made.symbol = from_.symbol;
        made.definition = to_.get();
        made.triangles.reserve(group_.corners.size());
        made.normal_corners.reserve(group_.corners.size());
        for (uint32_t w : group_.corners) {
            made.triangles.push_back(group_.position[w]);
            if (!group_.normal.empty()) made.normal_corners.push_back(group_.normal[w]);
        }
        for (VertexAttribute& a : to_->attributes) a.corners = group_.corners;
        out_.mesh.own_groups.push_back(std::move(to_));
        out_.groups.push_back(std::move(group_));
    }

  private:
    uint32_t wedge(DicePoint p) {
        uint32_t next = uint32_t(group_.position.size());
        int zeros = zero_weights(p);
        if (zeros == 2) {
            uint32_t& known = wedge_of_[wedges_[size_t(corner_of(p))]];
            if (known != kNone) return known;
            known = next;
        } else if (zeros == 1) {
            uint32_t known = edge_wedges_.number(wedges_, p, next);
            if (known != next) return known;
        }
        uint32_t at = position(p, zeros);
        group_.position.push_back(at);
        if (of_faces_ || !from_.flat()) group_.normal.push_back(normal(p, zeros, at));
        for (size_t a = 0; a < sources_.size(); ++a) {
            const VertexAttribute& from = *sources_[a];
            for (uint32_t c = 0; c < from.stride; ++c) {
                double sum = 0;
                for (int k = 0; k < 3; ++k)
                    sum += double(p.weight(k)) / kDiceOne *
                           from.values[size_t(from.corners[corner_[size_t(k)]]) * from.stride + c];
                to_->attributes[a].values.push_back(float(sum));
            }
        }
        return next;
    }

    uint32_t position(DicePoint p, int zeros) {
        if (zeros == 2) return positions_[size_t(corner_of(p))];
        uint32_t next = uint32_t(out_.position_stencils.size());
        if (zeros == 1) {
            uint32_t known = edge_positions_.number(positions_, p, next);
            if (known != next) return known;
        }
        out_.position_stencils.push_back(stencil(positions_, p));
        return next;
    }

    vec4 face_normal() const {
        dvec3 a(base_.positions[positions_[0]]);
        dvec3 n = glm::cross(dvec3(base_.positions[positions_[1]]) - a,
                             dvec3(base_.positions[positions_[2]]) - a);
        double length = glm::length(n);
        return vec4(length > 0 ? vec3(n / length) : vec3(0.0f), 0.0f);
    }

    uint32_t add_normal(const Stencil& from, vec4 value, uint32_t at) {
        out_.normal_stencils.push_back(from);
        out_.mesh.normal_positions.push_back(at);
        out_.mesh.normals.push_back(value);
        return uint32_t(out_.mesh.normals.size() - 1);
    }

    uint32_t normal(DicePoint p, int zeros, uint32_t at) {
        if (of_faces_) return add_normal({{0, 0, 0}, {0, 0, 0}}, face_, at);
        uint32_t next = uint32_t(out_.normal_stencils.size());
        if (zeros == 2) {
            uint32_t& known = normal_of_[normals_[size_t(corner_of(p))]];
            if (known != kNone) return known;
            known = next;
        } else if (zeros == 1) {
            uint32_t known = edge_normals_.number(normals_, p, next);
            if (known != next) return known;
        }
        Stencil s = stencil(normals_, p);
        dvec3 n = combine(s, base_.normals);
        double length = glm::length(n);
        return add_normal(s, vec4(length > 0 ? vec3(n / length) : vec3(0.0f), 0.0f), at);
    }

    const Mesh& base_;
    const MeshGroup& from_;
    bool of_faces_;  // its normals are those of its triangles
    EdgePoints& edge_positions_;
    DicedMesh& out_;
    std::unique_ptr<PrimitiveGroup> to_;
    DicedGroup group_;
    VertexAttribute barycentrics_;
    std::vector<const VertexAttribute*> sources_;
    std::vector<uint32_t> base_wedges_;           // of each corner
    std::vector<uint32_t> normal_of_, wedge_of_;  // new entry of each old one
    EdgePoints edge_normals_, edge_wedges_;
    std::array<size_t, 3> corner_{};  // the triangle under work
    Corners positions_{}, normals_{}, wedges_{};
    vec4 face_{0.0f};
    std::vector<uint32_t> numbers_;
};

// The edges of marked groups, between welded positions.
class MarkedEdges {
  public:
    MarkedEdges(const Mesh& base, std::span<const uint8_t> diced) : welded_(weld(base.positions)) {
        for (size_t g = 0; g < base.groups.size(); ++g) {
            if (!diced[g]) continue;
            const std::vector<uint32_t>& t = base.groups[g].triangles;
            for (size_t c = 0; c < t.size(); ++c) {
                auto [a, b] = ends(t[c], t[c - c % 3 + (c + 1) % 3]);
                edges_.number(a, b, 0);
            }
        }
    }
    bool contains(uint32_t p, uint32_t q) const {
        auto [a, b] = ends(p, q);
        return edges_.contains(a, b);
    }

  private:
    std::pair<uint32_t, uint32_t> ends(uint32_t p, uint32_t q) const {
        return std::minmax({welded_[p], welded_[q]});
    }
    std::vector<uint32_t> welded_;
    PairNumbers edges_;
};

DiceMetric metric_of(const Mesh& base, const uint32_t corners[3]) {
    dvec3 p0(base.positions[corners[0]]);
    dvec3 e1 = dvec3(base.positions[corners[1]]) - p0, e2 = dvec3(base.positions[corners[2]]) - p0;
    return {glm::dot(e1, e1), glm::dot(e1, e2), glm::dot(e2, e2)};
}

// Of a group that is not diced: only what lies on marked edges of the triangle is split.
bool on_marked_edge(const MarkedEdges& marked, const uint32_t corners[3], DicePoint a,
                    DicePoint b) {
    for (int k = 0; k < 3; ++k)
        if (a.weight(k) == 0 && b.weight(k) == 0)
            return marked.contains(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    return false;
}

}  // namespace

dvec3 combine(const Stencil& s, std::span<const vec4> entries) {
    dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k) sum += double(s.weight[k]) * dvec3(entries[s.entry[k]]);
    return sum;
}

size_t DicedMesh::triangles() const {
    size_t count = 0;
    for (const DicedGroup& group : groups) count += group.corners.size() / 3;
    return count;
}

std::vector<uint32_t> weld(std::span<const vec4> positions) {
    PairNumbers planes(positions.size()), points(positions.size());
    std::vector<uint32_t> result(positions.size());
    uint32_t plane_count = 0;
    auto bits = [](float x) { return std::bit_cast<uint32_t>(x + 0.0f); };  // -0 is 0
    for (uint32_t p = 0; p < positions.size(); ++p) {
        const vec4& at = positions[p];
        uint32_t plane = planes.number(bits(at.x), bits(at.y), plane_count);
        plane_count += plane == plane_count;
        result[p] = points.number(plane, bits(at.z), p);
    }
    return result;
}

std::optional<DicedMesh> dice_mesh(const Mesh& base, std::span<const uint8_t> diced,
                                   std::span<const uint8_t> moved, DiceTest too_long,
                                   size_t limit) {
    MarkedEdges marked(base, diced);
    std::atomic<size_t> total{0};
    std::vector<std::vector<DicedTriangle>> pieces(base.groups.size());
    for (size_t g = 0; g < base.groups.size(); ++g) {
        const std::vector<uint32_t>& triangles = base.groups[g].triangles;
        pieces[g].resize(triangles.size() / 3);
        parallel_for(0, pieces[g].size(), 16, [&](size_t begin, size_t end) {
            for (size_t t = begin; t < end; ++t) {
                if (total.load(std::memory_order_relaxed) > limit) return;
                const uint32_t* corners = &triangles[3 * t];
                auto test = [&](DicePoint a, DicePoint b) {
                    return (diced[g] || on_marked_edge(marked, corners, a, b)) &&
                           too_long(corners, a, b);
                };
                DicedTriangle& piece = pieces[g][t];
                bool fits = dice_triangle(metric_of(base, corners), test, limit, piece);
                total += fits ? piece.triangles.size() / 3 : limit + 1;
                if (piece.triangles.size() == 3) piece = {};  // itself
            }
        });
    }
    if (total > limit) return std::nullopt;
    std::optional<DicedMesh> result(std::in_place);
    DicedMesh& out = *result;
    out.mesh.anchor = base.anchor;
    out.mesh.low = base.low;
    out.mesh.high = base.high;
    out.mesh.double_sided = base.double_sided;
    out.mesh.definition = base.definition;
    for (uint32_t p = 0; p < base.positions.size(); ++p)
        out.position_stencils.push_back({{p, p, p}, {1, 0, 0}});
    EdgePoints edge_positions;
    for (size_t g = 0; g < base.groups.size(); ++g) {
        GroupDicer dicer(base, base.groups[g], moved[g], edge_positions, out);
        for (size_t t = 0; t < pieces[g].size(); ++t) dicer.triangle(t, pieces[g][t]);
        pieces[g] = {};
        dicer.finish();
    }
    for (const Stencil& s : out.position_stencils)
        out.mesh.positions.push_back(vec4(vec3(combine(s, base.positions)), 0.0f));
    return result;
}

}  // namespace kinora
