// runtime/scene/vertices/diced_mesh.cpp: vertices, wedges and attributes of diced triangles.
#include "runtime/scene/vertices/diced_mesh.h"

#include <algorithm>
#include <array>
#include <deque>
#include <glm/geometric.hpp>

#include "runtime/base/memory/pages.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/description/pair_numbers.h"

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

constexpr size_t kDicedGrain = 16384;

void put_position(const Mesh& base, uint32_t number, const Stencil& from, DicedMesh& out) {
    if (!out.position_stencils.empty()) out.position_stencils[number] = from;
    out.mesh.positions[number] = vec4(vec3(combine(from, base.positions)), 0.0f);
}

// How many wedges, positions and normals there are.
struct Counts {
    uint32_t wedges = 0, positions = 0, normals = 0;
};

// Numbers of a point at the rim of a part. Of those it shares with an earlier part only the wedge.
struct RimNumbers {
    uint32_t point, wedge, position, normal;
};

// Where a part's points and corners are in the mesh. Its points take the next wedge, position and
// normal each, but for what the rim says.
struct PartNumbers {
    Counts first;
    size_t first_corner = 0;
    std::vector<RimNumbers> rim;
};

constexpr std::array<uint32_t, 3> kItself = {0, 1, 2};

// The part with its lists, also where it is a triangle itself.
DicedPart complete(DicedPart part) {
    if (part.points.empty())
        part.points = kWholeTriangle, part.triangles = kItself, part.rim = kItself;
    return part;
}

// One group of the base mesh to its diced one: first the numbers of what parts share, one part
// after another, then all vertices at once.
class GroupDicer {
  public:
    GroupDicer(const Mesh& base, const MeshGroup& from, bool moved,
               const std::vector<DicedPart>& parts)
        : base_(base), from_(from), parts_(parts), of_faces_(moved && from.flat()) {
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
        own_wedges_ = barycentric || of_faces_;
        if (!own_wedges_) base_wedges_ = number_wedges(from);
        for (const VertexAttribute* a : sources_) {
            VertexAttribute& made = to_->attributes.emplace_back();
            made.semantic = a->semantic;
            made.set = a->set;
            made.stride = a->stride;
        }
    }

    // Numbers of positions and normals go on from `next`, which is then what follows them.
    void number(EdgePoints& edge_positions, Counts& next) {
        Shared shared(edge_positions);
        shared.normal_of.assign(base_.normals.size(), kNone);
        shared.wedge_of.assign(from_.triangles.size(), kNone);
        next.wedges = 0;
        uint32_t triangle = kNone;
        for (const DicedPart& any : parts_) {
            const DicedPart part = complete(any);
            if (part.triangle != triangle) shared.inside = PairNumbers();
            triangle = part.triangle;
            numbers_.push_back({next, corners_, {}});
            number_part(part, shared, numbers_.back(), next);
            corners_ += part.triangles.size();
        }
        wedges_ = next.wedges;
    }

    void fill(DicedMesh& out) {
        resize_pages(group_.corners, corners_);
        resize_pages(group_.position, wedges_);
        if (has_normals()) resize_pages(group_.normal, wedges_);
        for (VertexAttribute& a : to_->attributes)
            resize_pages(a.values, size_t(wedges_) * a.stride);
        const size_t grain = 1 + kDicedGrain * parts_.size() / (1 + corners_);
        parallel_for(0, parts_.size(), grain, [&](size_t begin, size_t end) {
            std::vector<uint32_t> wedge_of_point;
            for (size_t k = begin; k < end; ++k) fill_part(k, wedge_of_point, out);
        });
    }

    void finish(DicedMesh& out) {
        MeshGroup& made = out.mesh.groups.emplace_back();
        made.symbol = from_.symbol;
        made.definition = to_.get();
        resize_pages(made.triangles, corners_);
        if (has_normals()) resize_pages(made.normal_corners, corners_);
        parallel_for(0, corners_, kDicedGrain, [&](size_t begin, size_t end) {
            for (size_t c = begin; c < end; ++c) {
                const uint32_t wedge = group_.corners[c];
                made.triangles[c] = group_.position[wedge];
                if (has_normals()) made.normal_corners[c] = group_.normal[wedge];
            }
        });
        for (VertexAttribute& a : to_->attributes) {
            reserve_pages(a.corners, corners_);
            a.corners = group_.corners;
        }
        out.mesh.own_groups.push_back(std::move(to_));
        out.groups.push_back(std::move(group_));
    }

  private:
    // Numbers of what parts share.
    struct Shared {
        explicit Shared(EdgePoints& edges) : edge_positions(edges) {}
        EdgePoints& edge_positions;
        EdgePoints edge_normals, edge_wedges;
        std::vector<uint32_t> normal_of, wedge_of;  // new entry of each old one
        PairNumbers inside;                         // wedges inside the triangle under work
    };

    // A triangle's entries in the base mesh.
    struct Base {
        std::array<size_t, 3> corner;
        Corners positions{}, normals{}, wedges{};
    };

    bool has_normals() const { return of_faces_ || !from_.flat(); }

    Base base_of(size_t triangle) const {
        Base base;
        for (size_t k = 0; k < 3; ++k) {
            const size_t c = base.corner[k] = 3 * triangle + k;
            base.positions[k] = from_.triangles[c];
            if (!from_.flat()) base.normals[k] = from_.normal_corners[c];
            base.wedges[k] = own_wedges_ ? uint32_t(c) : base_wedges_[c];
        }
        return base;
    }

    void number_part(const DicedPart& part, Shared& shared, PartNumbers& numbers,
                     Counts& next) const {
        const Base base = base_of(part.triangle);
        uint32_t seen = 0;
        auto skip_to = [&](uint32_t point) {
            next.wedges += point - seen;
            next.positions += point - seen;
            if (has_normals()) next.normals += point - seen;
            seen = point;
        };
        for (uint32_t r : part.rim) {
            skip_to(r);
            numbers.rim.push_back(rim_point(r, part.points[r], base, shared, next));
            ++seen;
        }
        skip_to(uint32_t(part.points.size()));
    }

    RimNumbers rim_point(uint32_t r, DicePoint p, const Base& base, Shared& shared,
                         Counts& next) const {
        const int zeros = zero_weights(p);
        const size_t corner = size_t(corner_of(p));
        auto first_seen = [](uint32_t& known, uint32_t number) {
            return known == kNone ? known = number : known;
        };
        RimNumbers n{r, next.wedges, next.positions, next.normals};
        if (zeros == 2)
            n.wedge = first_seen(shared.wedge_of[base.wedges[corner]], n.wedge);
        else if (zeros == 1)
            n.wedge = shared.edge_wedges.number(base.wedges, p, n.wedge);
        else
            n.wedge = shared.inside.number(p.i, p.j, n.wedge);
        if (n.wedge != next.wedges) return n;
        ++next.wedges;
        if (zeros == 2)
            n.position = base.positions[corner];
        else if (zeros == 1)
            n.position = shared.edge_positions.number(base.positions, p, n.position);
        next.positions += n.position == next.positions;
        if (!has_normals()) return n;
        if (!of_faces_ && zeros == 2)
            n.normal = first_seen(shared.normal_of[base.normals[corner]], n.normal);
        else if (!of_faces_ && zeros == 1)
            n.normal = shared.edge_normals.number(base.normals, p, n.normal);
        next.normals += n.normal == next.normals;
        return n;
    }

    void fill_part(size_t k, std::vector<uint32_t>& wedge_of_point, DicedMesh& out) {
        const DicedPart part = complete(parts_[k]);
        const PartNumbers& numbers = numbers_[k];
        const Base base = base_of(part.triangle);
        const vec4 face = of_faces_ ? face_normal(base) : vec4(0.0f);
        wedge_of_point.clear();
        Counts next = numbers.first;
        auto rim = numbers.rim.begin();
        for (uint32_t i = 0; i < part.points.size(); ++i) {
            RimNumbers n{i, next.wedges, next.positions, next.normals};
            if (rim != numbers.rim.end() && rim->point == i) n = *rim++;
            wedge_of_point.push_back(n.wedge);
            if (n.wedge != next.wedges) continue;
            const DicePoint p = part.points[i];
            ++next.wedges;
            group_.position[n.wedge] = n.position;
            fill_attributes(n.wedge, p, base);
            if (n.position == next.positions) {
                put_position(base_, n.position, stencil(base.positions, p), out);
                ++next.positions;
            }
            if (!has_normals()) continue;
            group_.normal[n.wedge] = n.normal;
            if (n.normal != next.normals) continue;
            fill_normal(n, p, base, face, out);
            ++next.normals;
        }
        for (size_t c = 0; c < part.triangles.size(); ++c)
            group_.corners[numbers.first_corner + c] = wedge_of_point[part.triangles[c]];
    }

    void fill_attributes(size_t wedge, DicePoint p, const Base& base) {
        for (size_t a = 0; a < sources_.size(); ++a) {
            const VertexAttribute& from = *sources_[a];
            float* to = &to_->attributes[a].values[wedge * from.stride];
            for (uint32_t c = 0; c < from.stride; ++c) {
                double sum = 0;
                for (int k = 0; k < 3; ++k)
                    sum +=
                        double(p.weight(k)) / kDiceOne *
                        from.values[size_t(from.corners[base.corner[size_t(k)]]) * from.stride + c];
                to[c] = float(sum);
            }
        }
    }

    vec4 face_normal(const Base& base) const {
        dvec3 a(base_.positions[base.positions[0]]);
        dvec3 n = glm::cross(dvec3(base_.positions[base.positions[1]]) - a,
                             dvec3(base_.positions[base.positions[2]]) - a);
        double length = glm::length(n);
        return vec4(length > 0 ? vec3(n / length) : vec3(0.0f), 0.0f);
    }

    void fill_normal(const RimNumbers& n, DicePoint p, const Base& base, vec4 face,
                     DicedMesh& out) const {
        out.mesh.normal_positions[n.normal] = n.position;
        Stencil s = {{0, 0, 0}, {0, 0, 0}};
        if (!of_faces_) s = stencil(base.normals, p);
        if (!out.normal_stencils.empty()) out.normal_stencils[n.normal] = s;
        if (of_faces_) {
            out.mesh.normals[n.normal] = face;
            return;
        }
        const dvec3 sum = combine(s, base_.normals);
        const double length = glm::length(sum);
        out.mesh.normals[n.normal] = vec4(length > 0 ? vec3(sum / length) : vec3(0.0f), 0.0f);
    }

    const Mesh& base_;
    const MeshGroup& from_;
    const std::vector<DicedPart>& parts_;
    bool of_faces_;    // its normals are those of its triangles
    bool own_wedges_;  // every corner of the base mesh is a wedge
    std::unique_ptr<PrimitiveGroup> to_;
    DicedGroup group_;
    VertexAttribute barycentrics_;
    std::vector<const VertexAttribute*> sources_;
    std::vector<uint32_t> base_wedges_;  // of each corner
    std::vector<PartNumbers> numbers_;   // by part
    uint32_t wedges_ = 0;
    size_t corners_ = 0;
};

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

DicedMesh diced_mesh(const Mesh& base, std::span<const uint8_t> moved, const DicedParts& parts,
                     bool stencils) {
    DicedMesh out;
    out.mesh.anchor = base.anchor;
    out.mesh.low = base.low;
    out.mesh.high = base.high;
    out.mesh.double_sided = base.double_sided;
    out.mesh.definition = base.definition;
    EdgePoints edge_positions;
    Counts counts;
    counts.positions = uint32_t(base.positions.size());
    std::deque<GroupDicer> dicers;  // which stay where they are
    for (size_t g = 0; g < base.groups.size(); ++g) {
        dicers.emplace_back(base, base.groups[g], moved[g], parts.groups[g]);
        dicers.back().number(edge_positions, counts);
    }
    if (stencils) {
        resize_pages(out.position_stencils, counts.positions);
        resize_pages(out.normal_stencils, counts.normals);
    }
    resize_pages(out.mesh.positions, counts.positions);
    resize_pages(out.mesh.normals, counts.normals);
    resize_pages(out.mesh.normal_positions, counts.normals);
    for (uint32_t p = 0; p < base.positions.size(); ++p)
        put_position(base, p, {{p, p, p}, {1, 0, 0}}, out);
    for (GroupDicer& dicer : dicers) dicer.fill(out);
    for (GroupDicer& dicer : dicers) dicer.finish(out);
    return out;
}

}  // namespace kinora
