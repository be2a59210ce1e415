// runtime/scene/ri/state/attributes.cpp: attributes of shading and geometry but for shaders.
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/ri.h"
#include "runtime/scene/ri/state/interpreter.h"
#include "runtime/scene/ri/state/trim_curves.h"

namespace kinora::ri {
namespace {

struct NamedBasis {
    std::string_view name;
    const RtBasis* matrix;
};
const NamedBasis kBases[] = {
    {"bezier", &RiBezierBasis},   {"b-spline", &RiBSplineBasis},
    {"bspline", &RiBSplineBasis}, {"catmull-rom", &RiCatmullRomBasis},
    {"hermite", &RiHermiteBasis}, {"power", &RiPowerBasis},
};

std::optional<dmat4> basis_matrix(const Values& values) {
    const float* numbers = nullptr;
    if (values.kind() == Values::Kind::Strings) {
        for (const NamedBasis& named : kBases)
            if (named.name == values.string()) numbers = &(*named.matrix)[0][0];
    } else if (values.size() == 16) {
        numbers = values.floats().data();
    }
    if (!numbers) return std::nullopt;
    dmat4 m(1.0);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) m[c][r] = double(numbers[4 * r + c]);
    return m;
}

}  // namespace

dvec3 Interpreter::rgb(const Values& values) const {
    auto numbers = values.floats();
    dvec3 made(0.0);
    if (options_.to_rgb.empty()) {
        for (size_t k = 0; k < 3 && !numbers.empty(); ++k)
            made[int(k)] = double(numbers[std::min(k, numbers.size() - 1)]);
    } else {
        for (size_t i = 0; i < numbers.size() && 3 * i + 2 < options_.to_rgb.size(); ++i)
            for (size_t k = 0; k < 3; ++k)
                made[int(k)] += double(numbers[i]) * options_.to_rgb[3 * i + k];
    }
    for (int k = 0; k < 3; ++k)
        if (!std::isfinite(made[k])) made[k] = 0;
    return made;
}

void Interpreter::color(const Call& call) {
    attributes_.color = rgb(call.arguments[0]);
}

void Interpreter::opacity(const Call& call) {
    attributes_.opacity = rgb(call.arguments[0]);
}

void Interpreter::texture_coordinates(const Call& call) {
    for (size_t i = 0; i < 8; ++i) attributes_.corners[i] = double(call.arguments[i].real());
}

void Interpreter::shading_rate(const Call& call) {
    if (call.arguments[0].real() > 0) attributes_.shading_rate = double(call.arguments[0].real());
}

void Interpreter::matte(const Call& call) {
    attributes_.matte = call.arguments[0].integer() != 0;
    if (attributes_.matte) not_done("Matte", "the object is drawn as others are");
}

void Interpreter::attribute(const Call& call) {
    std::string_view group = call.arguments[0].string();
    for (const Parameter& p : call.parameters) {
        if (group == "identifier" && p.name == "name") attributes_.name = p.values.string();
        if (group == "light" && p.name == "shadows")
            attributes_.light_shadows = p.values.string() == "on";
        if (group == "light" && p.name == "nsamples")
            attributes_.light_samples = p.values.integer();
        if (group == "visibility" && p.name == "camera")
            attributes_.visible_to_camera = p.values.integer() != 0;
        if (group == "trimcurve" && p.name == "sense")
            attributes_.trim_outside = p.values.string() == "outside";
    }
}

void Interpreter::detail(const Call& call) {
    auto box = call.arguments[0].floats();
    attributes_.has_detail = box.size() == 6;
    for (size_t i = 0; i < 6 && i < box.size(); ++i) attributes_.detail_box[i] = double(box[i]);
}

// The area in pixels of the box that Detail gave decides; in a range of transition the nearer of
// both. Where no box was given all ranges are drawn.
void Interpreter::detail_range(const Call& call) {
    attributes_.in_detail_range = true;
    if (!attributes_.has_detail || !in_world()) return;
    double low = double(call.arguments[0].real()), lower = double(call.arguments[1].real());
    double upper = double(call.arguments[2].real()), high = double(call.arguments[3].real());
    const std::array<double, 6>& box = attributes_.detail_box;
    PictureScale scale = world_->scale(to_camera());
    dvec2 least(1e30), most(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
        dvec4 p = scale.to_camera * dvec4(box[corner & 1], box[2 + ((corner >> 1) & 1)],
                                          box[4 + ((corner >> 2) & 1)], 1);
        double z = scale.orthographic ? 1 : std::max(p.z, scale.near);
        dvec2 at = dvec2(p.x, p.y) * (scale.pixels / z);
        least = glm::min(least, at), most = glm::max(most, at);
    }
    double area = (most.x - least.x) * (most.y - least.y) * options_.relative_detail;
    attributes_.in_detail_range = area >= (low + lower) / 2 && area < (upper + high) / 2;
}

void Interpreter::orientation(const Call& call) {
    std::string_view side = call.arguments[0].string();
    bool left_handed = glm::determinant(to_camera()) > 0;  // camera space is
    if (side == "outside")
        attributes_.inside_out = false;
    else if (side == "inside")
        attributes_.inside_out = true;
    else if (side == "lh")
        attributes_.inside_out = !left_handed;
    else if (side == "rh")
        attributes_.inside_out = left_handed;
    else
        report(Code::RI_RANGE, "Orientation", "it is outside, inside, lh or rh");
}

void Interpreter::reverse_orientation(const Call&) {
    attributes_.inside_out = !attributes_.inside_out;
}

void Interpreter::sides(const Call& call) {
    int sides = call.arguments[0].integer();
    if (sides != 1 && sides != 2) return report(Code::RI_RANGE, "Sides", "it is 1 or 2");
    attributes_.two_sided = sides == 2;
}

void Interpreter::basis(const Call& call) {
    std::optional<dmat4> u = basis_matrix(call.arguments[0]), v = basis_matrix(call.arguments[2]);
    if (!u || !v)
        return report(Code::RI_RANGE, "Basis",
                      "it is bezier, b-spline, catmull-rom, hermite, power or 16 numbers");
    attributes_.u = {*u, uint32_t(std::max(call.arguments[1].integer(), 1))};
    attributes_.v = {*v, uint32_t(std::max(call.arguments[3].integer(), 1))};
}

void Interpreter::trim_curve(const Call& call) {
    std::string why;
    attributes_.trims = trim_loops(call, why);
    if (!why.empty()) report(Code::RI_COUNTS, "TrimCurve", why);
}

}  // namespace kinora::ri
