// runtime/scene/ri/state/polygons.cpp: polygons as triangles with their variables by corner.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/base/polygons/triangulate.h"
#include "runtime/scene/ri/state/primitives.h"

namespace kinora::ri {
namespace {

// Corners of polygons: loops one behind the other, the first of each polygon its outline.
struct Polygons {
    std::vector<uint32_t> loops;       // of each polygon, how many
    std::vector<uint32_t> loop_sizes;  // of each loop, corners
    std::vector<uint32_t> points;      // of each corner
};

std::vector<uint32_t> unsigned_of(std::span<const int> numbers) {
    std::vector<uint32_t> made;
    for (int n : numbers) made.push_back(uint32_t(std::max(n, 0)));
    return made;
}

Polygons polygons_of(const Call& call) {
    Polygons made;
    switch (call.request) {
        case Request::Polygon:
            made.loops = {1};
            made.loop_sizes = {call.counts.vertex};
            break;
        case Request::GeneralPolygon:
            made.loop_sizes = unsigned_of(call.arguments[0].integers());
            made.loops = {uint32_t(made.loop_sizes.size())};
            break;
        case Request::PointsPolygons:
            made.loop_sizes = unsigned_of(call.arguments[0].integers());
            made.loops.assign(made.loop_sizes.size(), 1);
            made.points = unsigned_of(call.arguments[1].integers());
            return made;
        default:
            made.loops = unsigned_of(call.arguments[0].integers());
            made.loop_sizes = unsigned_of(call.arguments[1].integers());
            made.points = unsigned_of(call.arguments[2].integers());
            return made;
    }
    made.points.resize(call.counts.vertex);
    std::iota(made.points.begin(), made.points.end(), 0u);
    return made;
}

// Triangles by number of corner, with the polygon that each is of.
struct Cut {
    std::vector<uint32_t> corners, polygons;
};

Cut cut(const Polygons& polygons, const std::vector<dvec3>& places, bool reversed) {
    Cut made;
    size_t loop = 0, corner = 0;
    std::vector<dvec3> outline;
    std::vector<uint32_t> triangles;
    for (size_t p = 0; p < polygons.loops.size(); ++p) {
        size_t count = std::min<size_t>(polygons.loops[p], polygons.loop_sizes.size() - loop);
        std::span<const uint32_t> loops(polygons.loop_sizes.data() + loop, count);
        size_t all = std::accumulate(loops.begin(), loops.end(), size_t(0));
        all = std::min(all, polygons.points.size() - corner);
        outline.clear();
        for (size_t i = 0; i < all; ++i) outline.push_back(places[polygons.points[corner + i]]);
        triangles.clear();
        bool finite = std::ranges::all_of(outline, [](dvec3 p3) {
            return std::isfinite(p3.x) && std::isfinite(p3.y) && std::isfinite(p3.z);
        });
        if (finite && all >= 3) triangulate(outline, loops, triangles);
        for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
            if (reversed) std::swap(triangles[t + 1], triangles[t + 2]);
            for (size_t k = 0; k < 3; ++k)
                made.corners.push_back(uint32_t(corner) + triangles[t + k]);
            made.polygons.push_back(uint32_t(p));
        }
        loop += count, corner += all;
    }
    return made;
}

// Values by corner of triangles.
class Variables {
  public:
    Variables(const Polygons& polygons, const Cut& cut) : polygons_(polygons), cut_(cut) {}

    std::vector<uint32_t> entries(StorageClass storage) const {
        std::vector<uint32_t> made(cut_.corners.size(), 0);
        for (size_t i = 0; i < made.size() && storage != StorageClass::Constant; ++i) {
            if (storage == StorageClass::Uniform)
                made[i] = cut_.polygons[i / 3];
            else if (storage == StorageClass::FaceVarying)
                made[i] = cut_.corners[i];
            else
                made[i] = polygons_.points[cut_.corners[i]];
        }
        return made;
    }
    // As Parameter `p` has them; nothing where its values are no numbers.
    std::optional<VertexAttribute> attribute(const Parameter& p, std::string semantic) const {
        auto numbers = p.values.floats();
        if (numbers.empty()) return std::nullopt;
        VertexAttribute made;
        made.semantic = std::move(semantic);
        made.stride = p.declaration.elements() * components(p.declaration.type, 3);
        made.values.assign(numbers.begin(), numbers.end());
        made.corners = entries(p.declaration.storage);
        uint32_t most = made.corners.empty() ? 0 : *std::ranges::max_element(made.corners);
        if (size_t(most + 1) * made.stride > made.values.size()) return std::nullopt;
        return made;
    }

  private:
    const Polygons& polygons_;
    const Cut& cut_;
};

// s and t of two variables, or x and y of the places.
VertexAttribute texture_attribute(const Call& call, const Variables& variables,
                                  const std::vector<dvec3>& places) {
    if (const Parameter* st = call.find("st"))
        if (auto made = variables.attribute(*st, "TEXCOORD"); made && made->stride >= 2)
            return *made;
    VertexAttribute made;
    made.semantic = "TEXCOORD";
    made.stride = 2;
    const Parameter *s = call.find("s"), *t = call.find("t");
    if (s && t && s->declaration == t->declaration && s->values.size() == t->values.size() &&
        s->values.kind() == Values::Kind::Floats) {
        for (size_t i = 0; i < s->values.size(); ++i) {
            made.values.push_back(s->values.floats()[i]);
            made.values.push_back(t->values.floats()[i]);
        }
        made.corners = variables.entries(s->declaration.storage);
        return made;
    }
    for (const dvec3& p : places) {
        made.values.push_back(float(p.x));
        made.values.push_back(float(p.y));
    }
    made.corners = variables.entries(StorageClass::Vertex);
    return made;
}

bool is_place_or_parameter(std::string_view name) {
    for (std::string_view known : {"P", "Pw", "Pz", "s", "t", "st", "N", "Np"})
        if (name == known) return true;
    return false;
}

}  // namespace

bool is_front_reversed(const Attributes& attributes) {
    return attributes.inside_out;
}

std::vector<dvec3> points_of(const Call& call) {
    const Parameter *p = call.find("P"), *pw = call.find("Pw");
    std::vector<dvec3> made;
    size_t stride = p ? 3 : 4;
    auto numbers = p ? p->values.floats() : pw ? pw->values.floats() : std::span<const float>();
    for (size_t i = 0; i + stride <= numbers.size(); i += stride) {
        double w = stride == 4 && numbers[i + 3] != 0 ? double(numbers[i + 3]) : 1;
        made.emplace_back(numbers[i] / w, numbers[i + 1] / w, numbers[i + 2] / w);
    }
    return made;
}

std::optional<MeshDefinition> polygon_mesh(const Call& call, const Attributes& attributes) {
    MeshDefinition mesh;
    mesh.positions = points_of(call);
    Polygons polygons = polygons_of(call);
    uint32_t most = polygons.points.empty() ? 0 : *std::ranges::max_element(polygons.points);
    if (polygons.points.empty() || most >= mesh.positions.size()) return std::nullopt;
    Cut triangles = cut(polygons, mesh.positions, is_front_reversed(attributes));
    if (triangles.corners.empty()) return std::nullopt;
    PrimitiveGroup& group = mesh.groups.emplace_back();
    for (uint32_t corner : triangles.corners) group.triangles.push_back(polygons.points[corner]);
    Variables variables(polygons, triangles);
    group.attributes.push_back(texture_attribute(call, variables, mesh.positions));
    for (const char* normal : {"N", "Np"})
        if (const Parameter* p = call.find(normal))
            if (auto made = variables.attribute(*p, "NORMAL"); made && made->stride == 3) {
                group.attributes.push_back(std::move(*made));
                break;
            }
    for (const Parameter& p : call.parameters)
        if (!is_place_or_parameter(p.name))
            if (auto made = variables.attribute(p, std::string(p.name)))
                group.attributes.push_back(std::move(*made));
    return mesh;
}

}  // namespace kinora::ri
