// collada/extract/polygons.cpp: the five kinds of primitives as triangles of vertices.
#include <algorithm>
#include <utility>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/polygon_shape_p.h"
#include "collada/extract/primitives_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/polygons/triangulate.h"

namespace kinora::collada {

namespace {

void read_part(Extraction& x, Link link, PrimitiveIndices& p, size_t expected = 0) {
    std::vector<int32_t> numbers = read_ints(x.document(link.doc), *link.element, x.diag, expected);
    size_t surplus = numbers.size() % p.stride;
    if (surplus) {
        x.diag.report(Code::PRIM_P_COUNT, x.where(link), numbers.size(), p.stride);
        numbers.resize(numbers.size() - surplus);
    }
    p.parts.push_back({link.element, p.vertex_count()});
    if (p.numbers.empty())
        p.numbers = std::move(numbers);
    else
        p.numbers.insert(p.numbers.end(), numbers.begin(), numbers.end());
}

// <ph>: one <p> and its <h> holes.
void read_holed(Extraction& x, Link link, PrimitiveIndices& p, PolygonList& polygons) {
    const Element* outline = link.element->child("p");
    if (!outline) {
        x.diag.report(Code::SCHEMA_MISSING_ELEMENT, x.where(link), "ph", "p");
        return;
    }
    polygons.first.push_back(p.vertex_count());
    read_part(x, {link.doc, outline}, p);
    polygons.loop_sizes.push_back(p.vertex_count() - polygons.first.back());
    uint32_t loops = 1;
    for (const Element& hole : link.element->children()) {
        if (hole.name != "h") continue;
        uint32_t before = p.vertex_count();
        read_part(x, {link.doc, &hole}, p);
        polygons.loop_sizes.push_back(p.vertex_count() - before);
        ++loops;
    }
    polygons.loops_of.push_back(loops);
}

void check_count(Extraction& x, Link primitive, size_t found) {
    uint64_t count = 0;
    const Attribute* a = primitive.element->attribute("count");
    if (!a)
        x.diag.report(Code::SRC_ATTRIBUTE, x.where(primitive), "count", primitive.element->name,
                      "is missing");
    else if (!parse_count(a->value, count))
        x.diag.report(Code::SRC_ATTRIBUTE, x.where(primitive, "count"), "count",
                      primitive.element->name, fmt::format("is '{}'", a->value));
    else if (count != found)
        x.diag.report(Code::PRIM_COUNT, x.where(primitive, "count"), count, found);
}

// About as many as the <p> of so many triangles or polygons holds; of others each <p> is one.
size_t expected_indices(const Element& primitive, uint32_t stride) {
    bool one_list = primitive.name == "triangles" || primitive.name == "polylist";
    size_t corners = primitive.name == "triangles" ? 3 : 4, most = SIZE_MAX / (4 * stride);
    return one_list ? std::min(written_count(primitive), most) * corners * stride : 0;
}

}  // namespace

PrimitiveIndices read_indices(Extraction& x, Link primitive, uint32_t stride,
                              PolygonList& polygons) {
    PrimitiveIndices p;
    p.stride = stride;
    for (const Element& child : primitive.element->children()) {
        Link link{primitive.doc, &child};
        if (child.name == "p") {
            polygons.first.push_back(p.vertex_count());
            read_part(x, link, p, expected_indices(*primitive.element, stride));
            polygons.loop_sizes.push_back(p.vertex_count() - polygons.first.back());
            polygons.loops_of.push_back(1);
        } else if (child.name == "ph") {
            read_holed(x, link, p, polygons);
        }
    }
    return p;
}

namespace {

// Shared by the five kinds: collects triangles, leaving out those with an unusable vertex.
class TriangleList {
  public:
    TriangleList(MeshReader& mesh, Link primitive, const PrimitiveIndices& p,
                 const PolygonList& polygons, const std::vector<bool>& usable, uint32_t offset)
        : mesh_(mesh),
          primitive_(primitive),
          p_(p),
          polygons_(polygons),
          usable_(usable),
          offset_(offset) {}

    void read_triangles();
    void read_polylist();
    void read_polygons();
    void read_strips();
    void read_fans();
    void report_shapes();
    std::vector<uint32_t> take() { return std::move(triangles_); }

  private:
    bool ok(uint32_t v) const { return usable_.empty() || usable_[v]; }
    void add(uint32_t a, uint32_t b, uint32_t c) {
        if (!ok(a) || !ok(b) || !ok(c)) return;
        for (uint32_t corner : {a, b, c}) triangles_.push_back(corner);
    }
    bool gather(uint32_t first, uint32_t count);
    void add_polygon(uint32_t first, std::span<const uint32_t> loops);
    void report_short(uint32_t count) {
        if (!short_reported_)
            mesh_.x.diag.report(Code::PRIM_STRIP_SHORT, mesh_.x.where(primitive_), count);
        short_reported_ = true;
    }

    MeshReader& mesh_;
    Link primitive_;
    const PrimitiveIndices& p_;
    const PolygonList& polygons_;
    const std::vector<bool>& usable_;
    uint32_t offset_;
    std::vector<uint32_t> triangles_;
    std::vector<dvec3> corners_;
    PolygonStatistics shapes_;  // of outlines, for the validator; strips and fans repeat corners
    bool short_reported_ = false, crossing_reported_ = false, hole_reported_ = false;
};

void TriangleList::read_triangles() {
    uint32_t count = p_.vertex_count() / 3;
    check_count(mesh_.x, primitive_, count);
    if (p_.vertex_count() % 3)
        mesh_.x.diag.report(Code::PRIM_P_COUNT, mesh_.x.where(primitive_), p_.numbers.size(),
                            3 * p_.stride);
    triangles_.reserve(size_t(count) * 3);
    for (uint32_t t = 0; t < count; ++t) add(3 * t, 3 * t + 1, 3 * t + 2);
    if (mesh_.x.options.everything)
        for (uint32_t t = 0; t < count; ++t)
            if (gather(3 * t, 3)) shapes_.add(corners_);
}

// The positions of corners that follow one another; false when one of them is not usable.
bool TriangleList::gather(uint32_t first, uint32_t count) {
    corners_.resize(count);
    for (uint32_t c = 0; c < count; ++c) {
        if (!ok(first + c)) return false;
        int32_t position = p_.numbers[size_t(first + c) * p_.stride + offset_];
        corners_[c] = mesh_.geometry.positions[size_t(position)];
    }
    return true;
}

void TriangleList::report_shapes() {
    Location where = mesh_.x.where(primitive_);
    Diagnostics& diag = mesh_.x.diag;
    if (shapes_.empty) diag.report(Code::PRIM_DEGENERATE, where, shapes_.empty, shapes_.polygons);
    if (shapes_.bent)
        diag.report(Code::PRIM_NON_PLANAR, where, shapes_.bent, shapes_.polygons,
                    100 * shapes_.worst_deviation);
    if (shapes_.crossing) diag.report(Code::PRIM_SELF_INTERSECT, where);
    if (shapes_.concave) diag.report(Code::PORT_CONCAVE, where, shapes_.concave);
}

// `loops` are the corner counts of outline and holes, which follow one another from `first`.
void TriangleList::add_polygon(uint32_t first, std::span<const uint32_t> loops) {
    if (loops[0] < 3) return report_short(loops[0]);
    uint32_t corners = 0;
    for (uint32_t loop : loops) corners += loop;
    if (!gather(first, corners)) return;
    if (mesh_.x.options.everything) shapes_.add(std::span(corners_).first(loops[0]));
    if (corners == 3) return add(first, first + 1, first + 2);
    size_t done = triangles_.size();
    Triangulation result = triangulate(corners_, loops, triangles_);
    for (size_t i = done; i < triangles_.size(); ++i) triangles_[i] += first;
    if (result.self_intersecting && !crossing_reported_) {
        crossing_reported_ = true;
        mesh_.x.diag.report(Code::PRIM_SELF_INTERSECT, mesh_.x.where(primitive_));
    }
    if (result.lost_holes && !hole_reported_) {
        hole_reported_ = true;
        mesh_.x.diag.report(Code::PRIM_HOLE_OUTSIDE, mesh_.x.where(primitive_));
    }
}

void TriangleList::read_polylist() {
    const Element* vcount = primitive_.element->child("vcount");
    if (!vcount) {
        mesh_.x.diag.report(Code::PRIM_VCOUNT, mesh_.x.where(primitive_),
                            "<polylist> has no <vcount>");
        return;
    }
    std::vector<int32_t> counts = read_ints(mesh_.x.document(primitive_.doc), *vcount, mesh_.x.diag,
                                            written_count(*primitive_.element));
    check_count(mesh_.x, primitive_, counts.size());
    triangles_.reserve(size_t(p_.vertex_count()) * 2);
    uint32_t at = 0;
    for (size_t i = 0; i < counts.size(); ++i) {
        uint32_t left = p_.vertex_count() - at;
        if (counts[i] < 0 || uint32_t(counts[i]) > left) {
            mesh_.x.diag.report(Code::PRIM_VCOUNT, mesh_.x.where({primitive_.doc, vcount}),
                                fmt::format("polygon {} asks for {} vertices, <p> has {} left", i,
                                            counts[i], left));
            return;
        }
        uint32_t corners = uint32_t(counts[i]);
        add_polygon(at, {&corners, 1});
        at += corners;
    }
    if (at != p_.vertex_count())
        mesh_.x.diag.report(
            Code::PRIM_VCOUNT, mesh_.x.where({primitive_.doc, vcount}),
            fmt::format("<vcount> sums to {}, <p> has {} vertices", at, p_.vertex_count()));
}

void TriangleList::read_polygons() {
    check_count(mesh_.x, primitive_, polygons_.first.size());
    size_t loop = 0;
    for (size_t i = 0; i < polygons_.first.size(); ++i) {
        std::span<const uint32_t> loops(&polygons_.loop_sizes[loop], polygons_.loops_of[i]);
        add_polygon(polygons_.first[i], loops);
        loop += polygons_.loops_of[i];
    }
}

// Every other triangle of a strip has its first two corners exchanged, so that all wind alike.
void TriangleList::read_strips() {
    check_count(mesh_.x, primitive_, polygons_.first.size());
    for (size_t i = 0; i < polygons_.first.size(); ++i) {
        uint32_t first = polygons_.first[i], count = polygons_.loop_sizes[i];
        if (count < 3) report_short(count);
        for (uint32_t k = 2; k < count; ++k) {
            uint32_t v = first + k;
            if (k % 2 == 0)
                add(v - 2, v - 1, v);
            else
                add(v - 1, v - 2, v);
        }
    }
}

void TriangleList::read_fans() {
    check_count(mesh_.x, primitive_, polygons_.first.size());
    for (size_t i = 0; i < polygons_.first.size(); ++i) {
        uint32_t first = polygons_.first[i], count = polygons_.loop_sizes[i];
        if (count < 3) report_short(count);
        for (uint32_t k = 2; k < count; ++k) add(first, first + k - 1, first + k);
    }
}

struct KindRow {
    std::string_view name;
    void (TriangleList::*read)();
};
constexpr KindRow kKinds[] = {{"triangles", &TriangleList::read_triangles},
                              {"polylist", &TriangleList::read_polylist},
                              {"polygons", &TriangleList::read_polygons},
                              {"tristrips", &TriangleList::read_strips},
                              {"trifans", &TriangleList::read_fans}};

const KindRow* find_row(std::string_view name) {
    for (const KindRow& row : kKinds)
        if (row.name == name) return &row;
    return nullptr;
}

}  // namespace

uint32_t count_lines(Extraction& x, Link primitive, const PrimitiveIndices& p,
                     const PolygonList& strips) {
    if (primitive.element->name == "lines") {
        check_count(x, primitive, p.vertex_count() / 2);
        if (p.vertex_count() % 2)
            x.diag.report(Code::PRIM_P_COUNT, x.where(primitive), p.numbers.size(), 2 * p.stride);
        return p.vertex_count() / 2;
    }
    check_count(x, primitive, strips.loop_sizes.size());
    uint32_t segments = 0;
    bool reported = false;
    for (uint32_t vertices : strips.loop_sizes) {
        if (vertices < 2 && !std::exchange(reported, true))
            x.diag.report(Code::PRIM_STRIP_SHORT, x.where(primitive), vertices);
        segments += vertices - std::min(vertices, 1u);
    }
    return segments;
}

bool is_triangulated(std::string_view name) {
    return find_row(name) != nullptr;
}

std::vector<uint32_t> triangles_of(MeshReader& mesh, Link primitive, const PrimitiveIndices& p,
                                   const PolygonList& polygons, const std::vector<bool>& usable,
                                   uint32_t position_offset) {
    TriangleList list(mesh, primitive, p, polygons, usable, position_offset);
    (list.*find_row(primitive.element->name)->read)();
    list.report_shapes();
    return list.take();
}

}  // namespace kinora::collada
