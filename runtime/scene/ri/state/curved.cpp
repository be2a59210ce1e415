// runtime/scene/ri/state/curved.cpp: quadrics, patches and NURBS as their numbers.
#include <algorithm>
#include <cmath>

#include "runtime/scene/ri/state/primitives.h"

namespace kinora::ri {
namespace {

struct QuadricRow {
    Request request;
    CurvedKind kind;
};
constexpr QuadricRow kQuadrics[] = {
    {Request::Sphere, CurvedKind::Sphere},         {Request::Cone, CurvedKind::Cone},
    {Request::Cylinder, CurvedKind::Cylinder},     {Request::Hyperboloid, CurvedKind::Hyperboloid},
    {Request::Paraboloid, CurvedKind::Paraboloid}, {Request::Disk, CurvedKind::Disk},
    {Request::Torus, CurvedKind::Torus},
};

VariableRate rate_of(StorageClass storage) {
    switch (storage) {
        case StorageClass::FaceVarying:
            return VariableRate::FaceVarying;
        case StorageClass::Constant:
            return VariableRate::Constant;
        case StorageClass::Uniform:
            return VariableRate::Uniform;
        case StorageClass::Vertex:
            return VariableRate::Vertex;
        default:
            return VariableRate::Varying;
    }
}

std::vector<SurfaceVariable> variables_of(const Call& call) {
    std::vector<SurfaceVariable> variables;
    for (const Parameter& p : call.parameters) {
        auto numbers = p.values.floats();
        if (p.name == "P" || p.name == "Pw" || p.name == "Pz" || numbers.empty()) continue;
        SurfaceVariable made;
        made.name = p.name == "Np" ? "N" : std::string(p.name);
        made.rate = rate_of(p.declaration.storage);
        made.components = p.declaration.elements() * components(p.declaration.type, 3);
        made.values.assign(numbers.begin(), numbers.end());
        variables.push_back(std::move(made));
    }
    return variables;
}

void take_variables(const Call& call, CurvedSurface& surface) {
    surface.variables = variables_of(call);
    for (SurfaceVariable& variable : surface.variables) {
        bool corners = is_quadric(surface.kind) && variable.rate == VariableRate::Vertex;
        if (corners || variable.rate == VariableRate::FaceVarying)
            variable.rate = VariableRate::Varying;
    }
}

// A basis whose weights have one sum that is not 1, as that of B-splines without its sixth. Places
// are then what is blended over the sum; all renderers known to us have it so.
bool is_scaled(const dmat4& basis) {
    const dvec4 sums = basis[0] + basis[1] + basis[2] + basis[3];  // of t^3, t^2, t, 1
    constexpr double kSame = 1e-5;
    return std::abs(sums.x) < kSame && std::abs(sums.y) < kSame && std::abs(sums.z) < kSame &&
           std::abs(sums.w - 1) > kSame;
}

// Points of P, of Pw, or of heights Pz over the unit square.
bool take_points(const Call& call, CurvedSurface& surface) {
    const Parameter *p = call.find("P"), *pw = call.find("Pw"), *pz = call.find("Pz");
    const size_t count = size_t(surface.u.points) * surface.v.points;
    const bool scaled = surface.kind == CurvedKind::Bicubic &&
                        (is_scaled(surface.u.basis) || is_scaled(surface.v.basis));
    surface.rational = (!p && pw) || scaled;
    auto numbers = p    ? p->values.floats()
                   : pw ? pw->values.floats()
                   : pz ? pz->values.floats()
                        : std::span<const float>();
    const size_t stride = p ? 3 : pw ? 4 : 1;
    if (numbers.size() < count * stride) return false;
    for (size_t i = 0; i < count; ++i) {
        const float* at = numbers.data() + i * stride;
        if (stride > 1) {
            surface.points.emplace_back(at[0], at[1], at[2], stride == 4 ? at[3] : 1.0f);
            continue;
        }
        double nu = std::max(surface.u.points - 1, 1u), nv = std::max(surface.v.points - 1, 1u);
        surface.points.emplace_back(double(i % surface.u.points) / nu,
                                    double(i / surface.u.points) / nv, double(at[0]), 1.0);
    }
    return true;
}

void take_patches(const Call& call, const Attributes& attributes, CurvedSurface& surface) {
    bool bicubic = call.arguments[0].string() == "bicubic";
    surface.kind = bicubic ? CurvedKind::Bicubic : CurvedKind::Bilinear;
    surface.u.basis = attributes.u.matrix, surface.v.basis = attributes.v.matrix;
    surface.u.step = attributes.u.step, surface.v.step = attributes.v.step;
    surface.u.points = surface.v.points = bicubic ? 4 : 2;
    if (call.request == Request::Patch) return;
    surface.u.points = uint32_t(std::max(call.arguments[1].integer(), 0));
    surface.v.points = uint32_t(std::max(call.arguments[3].integer(), 0));
    surface.u.periodic = call.arguments[2].string() == "periodic";
    surface.v.periodic = call.arguments[4].string() == "periodic";
}

void take_direction(std::span<const Values> arguments, PatchDirection& to) {
    to.points = uint32_t(std::max(arguments[0].integer(), 0));
    to.order = uint32_t(std::max(arguments[1].integer(), 0));
    for (float knot : arguments[2].floats()) to.knots.push_back(double(knot));
    to.low = double(arguments[3].real());
    to.high = double(arguments[4].real());
}

// More than a turn lies on itself. The sweep is the last number of each quadric.
void limit_turns(CurvedSurface& surface, size_t count) {
    double* numbers = surface.numbers;
    auto turn = [](double degrees) { return std::clamp(degrees, -360.0, 360.0); };
    numbers[count - 1] = turn(numbers[count - 1]);
    if (surface.kind == CurvedKind::Torus) numbers[3] = numbers[2] + turn(numbers[3] - numbers[2]);
}

}  // namespace

std::optional<CurvedSurface> curved_surface(const Call& call, const Attributes& attributes) {
    CurvedSurface surface;
    surface.reversed = is_front_reversed(attributes);
    std::ranges::copy(attributes.corners, surface.corners);
    auto quadric = std::ranges::find(kQuadrics, call.request, &QuadricRow::request);
    if (quadric != std::end(kQuadrics)) {
        surface.kind = quadric->kind;
        for (size_t i = 0; i < call.arguments.size() && i < std::size(surface.numbers); ++i)
            surface.numbers[i] = double(call.arguments[i].real());
        limit_turns(surface, call.arguments.size());
    } else if (call.request == Request::NuPatch) {
        surface.kind = CurvedKind::Nurbs;
        take_direction(call.arguments.subspan(0, 5), surface.u);
        take_direction(call.arguments.subspan(5, 5), surface.v);
        surface.trims = attributes.trims;
        surface.trim_outside = attributes.trim_outside;
    } else {
        take_patches(call, attributes, surface);
    }
    if (!is_quadric(surface.kind) && !take_points(call, surface)) return std::nullopt;
    take_variables(call, surface);
    return surface;
}

SubdivisionSurface subdivision_surface(const Call& call, const Attributes& attributes) {
    SubdivisionSurface surface;
    surface.reversed = is_front_reversed(attributes);
    for (int size : call.arguments[1].integers())
        surface.face_sizes.push_back(uint32_t(std::max(size, 0)));
    uint32_t most = 0;
    for (int index : call.arguments[2].integers()) {
        surface.indices.push_back(uint32_t(std::max(index, 0)));
        most = std::max(most, surface.indices.back());
    }
    surface.points = points_of(call);
    if (most >= surface.points.size()) surface.points.clear();
    auto tags =
        call.arguments.size() > 3 ? call.arguments[3].strings() : std::span<const char* const>();
    auto counts = call.arguments.size() > 4 ? call.arguments[4].integers() : std::span<const int>();
    size_t integer = 0;
    for (size_t tag = 0; tag < tags.size(); ++tag) {
        int count = 2 * tag < counts.size() ? std::max(counts[2 * tag], 0) : 0;
        auto integers = call.arguments[5].integers();
        if (tags[tag] == std::string_view("interpolateboundary")) {
            int value = count > 0 && integer < integers.size() ? integers[integer] : 1;
            surface.draw_boundary = value != 0;
            surface.sharp_corners = value != 2;
        }
        integer += size_t(count);
    }
    surface.variables = variables_of(call);
    return surface;
}

bool has_creases(const Call& call) {
    if (call.arguments.size() <= 3) return false;
    auto tags = call.arguments[3].strings();
    return std::ranges::any_of(tags, [](std::string_view tag) {
        return tag == "crease" || tag == "corner" || tag == "hole";
    });
}

}  // namespace kinora::ri
