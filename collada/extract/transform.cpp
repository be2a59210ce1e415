// collada/extract/transform.cpp: the six transforms of a node, kept as they are written.
#include <algorithm>
#include <cmath>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

struct TransformRow {
    std::string_view name;
    TransformKind kind;
    uint8_t count;
    std::array<double, 16> identity;
};

constexpr TransformRow kTransforms[] = {
    {"translate", TransformKind::Translate, 3, {0, 0, 0}},
    {"rotate", TransformKind::Rotate, 4, {0, 0, 1, 0}},
    {"scale", TransformKind::Scale, 3, {1, 1, 1}},
    {"matrix", TransformKind::Matrix, 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
    {"lookat", TransformKind::Lookat, 9, {0, 0, 1, 0, 0, 0, 0, 1, 0}},
    {"skew", TransformKind::Skew, 7, {0, 1, 0, 0, 0, 1, 0}},
};

const TransformRow* find_row(std::string_view name) {
    for (const TransformRow& row : kTransforms)
        if (row.name == name) return &row;
    return nullptr;
}

double length(const double* v) {
    return std::hypot(v[0], v[1], v[2]);
}

// What makes the values no transform; null if nothing.
const char* fault(TransformKind kind, const std::array<double, 16>& v) {
    if (kind == TransformKind::Rotate && length(&v[0]) == 0 && v[3] != 0) return "has a zero axis";
    if (kind == TransformKind::Skew && (length(&v[1]) == 0 || length(&v[4]) == 0))
        return "has a zero axis";
    if (kind == TransformKind::Skew && std::abs(std::cos(radians(v[0]))) < 1e-9)
        return "skews by a right angle";
    if (kind == TransformKind::Lookat) {
        dvec3 ahead(v[3] - v[0], v[4] - v[1], v[5] - v[2]);
        dvec3 up(v[6], v[7], v[8]);
        dvec3 side(ahead.y * up.z - ahead.z * up.y, ahead.z * up.x - ahead.x * up.z,
                   ahead.x * up.y - ahead.y * up.x);
        if (length(&ahead.x) == 0) return "looks at its own place";
        if (length(&side.x) == 0) return "has an up vector along its view";
    }
    return nullptr;
}

void transpose(std::array<double, 16>& m) {
    for (size_t c = 0; c < 4; ++c)
        for (size_t r = 0; r < c; ++r) std::swap(m[c * 4 + r], m[r * 4 + c]);
}

}  // namespace

bool is_transform(std::string_view name) {
    return find_row(name) != nullptr;
}

Transform read_transform(Extraction& x, Link link) {
    const TransformRow& row = *find_row(link.element->name);
    Transform transform{
        row.kind,
        {row.identity, row.count, std::string(link.element->value("sid")), x.where(link)}};
    auto& v = transform.slot.values;
    std::vector<double> numbers = read_doubles(x.document(link.doc), *link.element, x.diag);
    bool finite = true;
    for (double n : numbers) finite = finite && std::isfinite(n);
    // A short list fills the front, except that half a matrix or axis means nothing.
    bool usable = finite && (numbers.size() >= row.count || row.count == 3);
    if (usable)
        std::copy_n(numbers.begin(), std::min<size_t>(numbers.size(), row.count), v.begin());
    if (!finite) x.diag.report(Code::NODE_VALUE, x.where(link), row.name, "has a value not finite");
    if (finite && numbers.size() < row.count)
        x.diag.report(Code::NODE_NUMBERS, x.where(link), row.name, numbers.size(), row.count);
    if (const char* what = fault(row.kind, v)) {
        x.diag.report(Code::NODE_VALUE, x.where(link), row.name, what);
        // A lookat without an up still has its place and its view: lookat_matrix picks the axis.
        if (row.kind != TransformKind::Lookat) v = row.identity;
    }
    if (row.kind == TransformKind::Matrix) {
        if (std::ranges::all_of(v, [](double n) { return n == 0; })) {
            x.diag.report(Code::NODE_MATRIX_ZERO, x.where(link));
            v[15] = 1;
        }
        if (v[12] != 0 || v[13] != 0 || v[14] != 0 || v[15] != 1) {
            x.diag.report(Code::NODE_MATRIX_ROW, x.where(link), v[12], v[13], v[14], v[15]);
            v[12] = v[13] = v[14] = 0;
            v[15] = 1;
        }
        transpose(v);
    }
    return transform;
}

namespace {

constexpr std::string_view kBlenderOrder[] = {"scale", "rotationZ", "rotationY", "rotationX",
                                              "location"};

}  // namespace

void mend_order(Extraction& x, Link node, std::vector<Transform>& transforms) {
    if (transforms.size() != std::size(kBlenderOrder)) return;
    for (size_t i = 0; i < transforms.size(); ++i)
        if (transforms[i].slot.sid != kBlenderOrder[i]) return;
    if (transforms.front().kind != TransformKind::Scale ||
        transforms.back().kind != TransformKind::Translate ||
        !authoring_tool(x.document(node.doc)).starts_with("Blender"))
        return;
    const Element *first = nullptr, *last = nullptr;
    for (const Element& child : node.element->children()) {
        if (!is_transform(child.name)) continue;
        if (!first) first = &child;
        last = &child;
    }
    std::swap(transforms.front(), transforms.back());
    std::swap(x.target_of[first].slot, x.target_of[last].slot);
    if (x.disordered.insert(node.doc).second)
        x.diag.report(Code::NODE_ORDER, x.where({node.doc, first}));
}

}  // namespace kinora::collada
