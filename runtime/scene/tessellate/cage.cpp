// runtime/scene/tessellate/cage.cpp: the steps of Catmull and Clark.
//
// Catmull, Clark: Recursively generated B-spline surfaces on arbitrary topological meshes (CAD 10,
// 1978). Boundaries are cubic B-splines of their points, as RISpec 3.2 has them.
#include "runtime/scene/tessellate/cage_p.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace kinora::tessellation {

namespace {

// Faces of any size.
struct Polygons {
    std::vector<uint32_t> first{0};  // of each face's corners, and the end
    std::vector<uint32_t> corners, edges;
    std::vector<uint32_t> face, index;  // what the surface calls each face and its first corner
};

struct CageEdges {
    std::unordered_map<uint64_t, uint32_t> numbers;
    std::vector<CageEdge> list;

    uint32_t add(uint32_t a, uint32_t b) {
        auto [low, high] = std::minmax(a, b);
        auto [at, made] = numbers.try_emplace(uint64_t(low) << 32 | high, uint32_t(list.size()));
        if (made) list.push_back({low, high, 0});
        ++list[at->second].faces;
        return at->second;
    }
};

bool sound_face(const uint32_t* corners, uint32_t size, size_t points) {
    if (size < 3) return false;
    std::vector<uint32_t> sorted(corners, corners + size);
    std::sort(sorted.begin(), sorted.end());
    return sorted.back() < points &&
           std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

Polygons sound_polygons(const SubdivisionSurface& surface) {
    Polygons result;
    size_t at = 0;
    for (uint32_t f = 0; f < surface.face_sizes.size(); ++f) {
        const uint32_t size = surface.face_sizes[f];
        if (size > surface.indices.size() - at) break;
        const uint32_t* corners = surface.indices.data() + at;
        if (sound_face(corners, size, surface.points.size())) {
            result.corners.insert(result.corners.end(), corners, corners + size);
            result.first.push_back(uint32_t(result.corners.size()));
            result.face.push_back(f);
            result.index.push_back(uint32_t(at));
        }
        at += size;
    }
    return result;
}

// Adds factor x point `from` of one list of values to point `to` of another.
void add_point(std::vector<double>& values, size_t to, double factor,
               const std::vector<double>& source, size_t from, uint32_t stride) {
    for (uint32_t c = 0; c < stride; ++c)
        values[to * stride + c] += factor * source[from * stride + c];
}

// How many edges and faces meet at a point.
struct Meeting {
    uint32_t edges = 0, faces = 0, sharp = 0;
};

// The points of the next step: the old ones moved, then one a face, then one an edge.
class Stepped {
  public:
    // `face`: the corners of face f are corners[first(f)] to corners[first(f + 1)].
    template <class First>
    Stepped(const Cage& cage, const uint32_t* corners, const uint32_t* edges, size_t faces,
            First first)
        : cage_(cage), points_(cage.points()), stride_(cage.stride) {
        values_.assign((points_ + faces + cage.edges.size()) * stride_, 0.0);
        meetings_.resize(points_);
        for (size_t f = 0; f < faces; ++f)
            for (size_t k = first(f); k < first(f + 1); ++k) {
                add_point(values_, points_ + f, 1.0 / double(first(f + 1) - first(f)), cage.values,
                          corners[k], stride_);
                ++meetings_[corners[k]].faces;
            }
        for (size_t e = 0; e < cage.edges.size(); ++e) {
            ++meetings_[cage.edges[e].from].edges;
            ++meetings_[cage.edges[e].to].edges;
            meetings_[cage.edges[e].from].sharp += !cage.edges[e].smooth();
            meetings_[cage.edges[e].to].sharp += !cage.edges[e].smooth();
        }
        const size_t first_edge = points_ + faces;
        for (size_t f = 0; f < faces; ++f)
            for (size_t k = first(f); k < first(f + 1); ++k) {
                if (cage.edges[edges[k]].smooth())
                    add_point(values_, first_edge + edges[k], 0.25, values_, points_ + f, stride_);
                if (inner(corners[k]))
                    add_point(values_, corners[k], share(corners[k]), values_, points_ + f,
                              stride_);
            }
        for (size_t e = 0; e < cage.edges.size(); ++e) add_edge(first_edge + e, cage.edges[e]);
        for (size_t p = 0; p < points_; ++p) add_point(values_, p, own(p), cage.values, p, stride_);
    }

    std::vector<double> take() { return std::move(values_); }

  private:
    bool inner(size_t p) const { return meetings_[p].sharp == 0; }
    bool on_curve(size_t p) const { return meetings_[p].sharp == 2 && !cage_.fixed[p]; }
    // (Q + 2 R + (n - 3) S) / n, with Q the mean of face points, R of the edges' middles.
    double share(size_t p) const {
        const double n = meetings_[p].edges;
        return 1 / (n * n);
    }
    double own(size_t p) const {
        if (inner(p)) {
            const double n = std::max(1u, meetings_[p].edges);
            return (n - 3) / n + 1 / n;  // R has half of the point itself
        }
        return on_curve(p) ? 0.75 : 1;
    }
    void add_edge(size_t point, const CageEdge& edge) {
        const double half = edge.smooth() ? 0.25 : 0.5;
        for (auto [end, other] : {std::pair(edge.from, edge.to), std::pair(edge.to, edge.from)}) {
            add_point(values_, point, half, cage_.values, end, stride_);
            const double weight = inner(end)                        ? share(end)
                                  : on_curve(end) && !edge.smooth() ? 0.125
                                                                    : 0;
            if (weight != 0) add_point(values_, end, weight, cage_.values, other, stride_);
        }
    }

    const Cage& cage_;
    size_t points_;
    uint32_t stride_;
    std::vector<double> values_;
    std::vector<Meeting> meetings_;
};

// Halves of old edges, then one a corner of a face: from its edge's middle to the face's.
std::vector<CageEdge> next_edges(const Cage& cage, size_t faces, const uint32_t* edges,
                                 const std::vector<uint32_t>& first) {
    const uint32_t points = uint32_t(cage.points()), middles = points + uint32_t(faces);
    std::vector<CageEdge> result;
    result.reserve(2 * cage.edges.size() + first.back());
    for (uint32_t e = 0; e < cage.edges.size(); ++e) {
        result.push_back({cage.edges[e].from, middles + e, cage.edges[e].faces});
        result.push_back({middles + e, cage.edges[e].to, cage.edges[e].faces});
    }
    for (uint32_t f = 0; f < faces; ++f)
        for (uint32_t k = first[f]; k < first[f + 1]; ++k)
            result.push_back({middles + edges[k], points + f, 2});
    return result;
}

// What the children of one face are made of.
struct FaceParts {
    const Cage& cage;
    const uint32_t* corners;
    const uint32_t* edges;
    uint32_t size;
    uint32_t centre;   // point
    uint32_t middles;  // the point of edge 0
    uint32_t spokes;   // the edge from the middle of this face's edge 0 to its centre

    uint32_t half(uint32_t k, uint32_t corner) const {
        return 2 * edges[k] + (cage.edges[edges[k]].from != corners[corner]);
    }
    // The child at a corner, from the corner on: the corner, its edge's middle, the centre, the
    // middle of the edge before.
    void child(uint32_t k, std::array<uint32_t, 4>& quad, std::array<uint32_t, 4>& sides) const {
        const uint32_t before = (k + size - 1) % size;
        quad = {corners[k], middles + edges[k], centre, middles + edges[before]};
        sides = {half(k, k), spokes + k, spokes + before, half(before, k)};
    }
};

void add_children(const FaceParts& parts, const QuadPlace& place, bool keeps_root, Cage& next) {
    constexpr float kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (uint32_t k = 0; k < parts.size; ++k) {
        std::array<uint32_t, 4> quad, sides;
        parts.child(k, quad, sides);
        if (!keeps_root) {
            next.places.push_back({place.root + k, 0, 0, 1});
        } else {
            // Turned so that u and v run as in the root.
            std::rotate(quad.begin(), quad.begin() + (4 - k) % 4, quad.end());
            std::rotate(sides.begin(), sides.begin() + (4 - k) % 4, sides.end());
            const float half = place.size / 2;
            next.places.push_back({place.root, place.u + half * kCorners[k][0],
                                   place.v + half * kCorners[k][1], half});
        }
        next.quads.push_back(quad);
        next.quad_edges.push_back(sides);
    }
}

// The step for faces of any size; `places` are of the faces, and those of other than four corners
// become roots.
Cage step(const Cage& cage, const std::vector<uint32_t>& first, const uint32_t* corners,
          const uint32_t* edges, const std::vector<QuadPlace>& places) {
    const size_t faces = first.size() - 1;
    Cage next;
    next.stride = cage.stride;
    next.values = Stepped(cage, corners, edges, faces, [&](size_t f) { return first[f]; }).take();
    next.edges = next_edges(cage, faces, edges, first);
    next.fixed = cage.fixed;
    next.fixed.resize(next.points(), 0);
    next.quads.reserve(first.back());
    next.quad_edges.reserve(first.back());
    next.places.reserve(first.back());
    const uint32_t points = uint32_t(cage.points());
    for (uint32_t f = 0; f < faces; ++f) {
        const uint32_t size = first[f + 1] - first[f];
        add_children({cage, corners + first[f], edges + first[f], size, points + f,
                      points + uint32_t(faces), 2 * uint32_t(cage.edges.size()) + first[f]},
                     places[f], size == 4, next);
    }
    return next;
}

std::vector<double> values_of(const SubdivisionSurface& surface,
                              const std::vector<const SurfaceVariable*>& variables,
                              uint32_t stride) {
    std::vector<double> values;
    values.reserve(surface.points.size() * stride);
    for (size_t p = 0; p < surface.points.size(); ++p) {
        for (int c = 0; c < 3; ++c) values.push_back(surface.points[p][c]);
        for (const SurfaceVariable* v : variables)
            for (uint32_t c = 0; c < v->components; ++c)
                values.push_back(v->values[p * v->components + c]);
    }
    return values;
}

// Points of one face alone, and those at which edges of the boundary do not simply go on.
std::vector<uint8_t> fixed_points(const SubdivisionSurface& surface, const Polygons& polygons,
                                  const std::vector<CageEdge>& edges) {
    std::vector<uint32_t> sharp(surface.points.size(), 0), faces(surface.points.size(), 0);
    for (uint32_t corner : polygons.corners) ++faces[corner];
    for (const CageEdge& edge : edges) {
        sharp[edge.from] += !edge.smooth();
        sharp[edge.to] += !edge.smooth();
    }
    std::vector<uint8_t> fixed(surface.points.size());
    for (size_t p = 0; p < fixed.size(); ++p)
        fixed[p] = (sharp[p] != 0 && sharp[p] != 2) || (faces[p] == 1 && surface.sharp_corners);
    return fixed;
}

std::vector<RootQuad> make_roots(const SubdivisionSurface& surface, const Polygons& polygons,
                                 const std::vector<CageEdge>& edges,
                                 std::vector<QuadPlace>& places) {
    std::vector<uint8_t> outer(surface.points.size(), 0);
    for (const CageEdge& edge : edges)
        if (edge.faces == 1) outer[edge.from] = outer[edge.to] = 1;
    std::vector<RootQuad> roots;
    for (size_t f = 0; f + 1 < polygons.first.size(); ++f) {
        const uint32_t *begin = &polygons.corners[polygons.first[f]],
                       size = polygons.first[f + 1] - polygons.first[f];
        const bool drawn = surface.draw_boundary ||
                           std::none_of(begin, begin + size, [&](uint32_t p) { return outer[p]; });
        places.push_back({uint32_t(roots.size()), 0, 0, 1});
        for (uint32_t k = 0; k < (size == 4 ? 1 : size); ++k)
            roots.push_back({polygons.face[f], polygons.index[f], size, k, drawn});
    }
    return roots;
}

}  // namespace

Cage make_cage(const SubdivisionSurface& surface,
               const std::vector<const SurfaceVariable*>& vertex_variables) {
    Polygons polygons = sound_polygons(surface);
    CageEdges edges;
    for (size_t f = 0; f + 1 < polygons.first.size(); ++f) {
        const uint32_t first = polygons.first[f], end = polygons.first[f + 1];
        for (uint32_t k = first; k < end; ++k)
            polygons.edges.push_back(
                edges.add(polygons.corners[k], polygons.corners[k + 1 < end ? k + 1 : first]));
    }
    Cage cage;
    for (const SurfaceVariable* v : vertex_variables) cage.stride += v->components;
    cage.values = values_of(surface, vertex_variables, cage.stride);
    cage.fixed = fixed_points(surface, polygons, edges.list);
    std::vector<RootQuad> roots = make_roots(surface, polygons, edges.list, cage.places);
    cage.edges = std::move(edges.list);
    const bool all_quads =
        polygons.corners.size() == roots.size() * 4 && polygons.face.size() == roots.size();
    if (all_quads) {
        for (size_t k = 0; k < polygons.corners.size(); k += 4) {
            const uint32_t *p = &polygons.corners[k], *e = &polygons.edges[k];
            cage.quads.push_back({p[0], p[1], p[2], p[3]});
            cage.quad_edges.push_back({e[0], e[1], e[2], e[3]});
        }
    } else {
        cage =
            step(cage, polygons.first, polygons.corners.data(), polygons.edges.data(), cage.places);
    }
    cage.roots = std::move(roots);
    return cage;
}

Cage refine(const Cage& cage) {
    std::vector<uint32_t> first(cage.quads.size() + 1);
    for (size_t f = 0; f < first.size(); ++f) first[f] = uint32_t(4 * f);
    return step(cage, first, cage.quads.data()->data(), cage.quad_edges.data()->data(),
                cage.places);
}

}  // namespace kinora::tessellation
