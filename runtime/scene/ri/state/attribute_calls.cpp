// runtime/scene/ri/state/attribute_calls.cpp: attributes of shading and geometry but for shaders.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <span>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/ri.h"
#include "runtime/scene/ri/state/attribute_calls.h"
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

// What an integer or word of a renderer says of an object's visibility. Masks are of bits.
struct VisibilityRow {
    std::string_view group, name, hidden_by;  // the word that hides it
    int mask;
    bool Visibility::*flag;
};
constexpr int kAnyBit = ~0;
constexpr VisibilityRow kVisibility[] = {
    {"visibility", "camera", "", kAnyBit, &Visibility::camera},
    {"visibility", "specular", "", kAnyBit, &Visibility::reflections},
    {"visibility", "diffuse", "", kAnyBit, &Visibility::diffuse},
    {"visibility", "indirect", "", kAnyBit, &Visibility::diffuse},
    {"visibility", "trace", "", kAnyBit, &Visibility::reflections},
    {"visibility", "trace", "", kAnyBit, &Visibility::diffuse},
    {"visibility", "transmission", "transparent", kAnyBit, &Visibility::shadows},
    {"render", "visibility", "", 1, &Visibility::camera},
    {"render", "visibility", "", 2, &Visibility::reflections},
    {"render", "visibility", "", 2, &Visibility::diffuse},
    {"render", "visibility", "", 4, &Visibility::shadows},
    {"render", "casts_shadows", "none", kAnyBit, &Visibility::shadows},
};

void set_visibility(std::string_view group, const Parameter& parameter, Visibility& visibility) {
    const bool is_word = parameter.values.kind() == Values::Kind::Strings;
    for (const VisibilityRow& row : kVisibility)
        if (row.group == group && row.name == parameter.name)
            visibility.*row.flag = is_word ? parameter.values.string() != row.hidden_by
                                           : (parameter.values.integer() & row.mask) != 0;
}

// Attributes that are one of a few words. Others are of one renderer each, and change nothing.
constexpr std::string_view kOnOff[] = {"off", "on"};
constexpr std::string_view kSenses[] = {"inside", "outside"};
constexpr std::string_view kCasters[] = {"Os", "none", "opaque", "shade"};
constexpr std::string_view kTransmissions[] = {"opaque", "transparent", "Os", "shader"};
struct WordRow {
    std::string_view group, name;
    std::span<const std::string_view> words;  // the first stands for what is none of them
};
constexpr WordRow kWords[] = {
    {"light", "shadows", kOnOff},
    {"trimcurve", "sense", kSenses},
    {"render", "casts_shadows", kCasters},
    {"visibility", "transmission", kTransmissions},
};

}  // namespace

bool AttributeCalls::call(const Call& call) {
    using R = Request;
    using C = AttributeCalls;
    static const Handlers<C> kHandlers = {
        {R::Color, &C::color},
        {R::Opacity, &C::opacity},
        {R::TextureCoordinates, &C::texture_coordinates},
        {R::ShadingRate, &C::shading_rate},
        {R::Matte, &C::matte},
        {R::Attribute, &C::attribute},
        {R::Detail, &C::detail},
        {R::DetailRange, &C::detail_range},
        {R::Orientation, &C::orientation},
        {R::ReverseOrientation, &C::reverse_orientation},
        {R::Sides, &C::sides},
        {R::Basis, &C::basis},
        {R::TrimCurve, &C::trim_curve},
    };
    return kHandlers.call(*this, call);
}

void AttributeCalls::color(const Call& call) {
    state_.attributes.color = rgb_of(call.arguments[0], state_.options);
}

void AttributeCalls::opacity(const Call& call) {
    state_.attributes.opacity = rgb_of(call.arguments[0], state_.options);
}

void AttributeCalls::texture_coordinates(const Call& call) {
    for (size_t i = 0; i < 8; ++i) state_.attributes.corners[i] = double(call.arguments[i].real());
}

void AttributeCalls::shading_rate(const Call& call) {
    if (call.arguments[0].real() > 0)
        state_.attributes.shading_rate = double(call.arguments[0].real());
}

void AttributeCalls::matte(const Call& call) {
    state_.attributes.visibility.matte = call.arguments[0].integer() != 0;
}

void AttributeCalls::attribute(const Call& call) {
    std::string_view group = call.arguments[0].string();
    if (group != "identifier") keep_told(state_.attributes.told, call);  // files have very many
    for (const Parameter& p : call.parameters) {
        judge_word(group, p);
        if (group == "identifier" && p.name == "name") state_.attributes.name = p.values.string();
        if (group == "light" && p.name == "shadows")
            state_.attributes.light_shadows = p.values.string() == "on";
        if (group == "light" && p.name == "nsamples")
            state_.attributes.light_samples = p.values.integer();
        set_visibility(group, p, state_.attributes.visibility);
        if (group == "trimcurve" && p.name == "sense")
            state_.attributes.trim_outside = p.values.string() == "outside";
    }
}

void AttributeCalls::judge_word(std::string_view group, const Parameter& p) {
    if (p.values.kind() != Values::Kind::Strings) return;
    const std::string_view word = p.values.string();
    for (const WordRow& row : kWords)
        if (row.group == group && row.name == p.name && !std::ranges::count(row.words, word))
            report_.add(Code::RI_TOKEN_WRONG, fmt::format("Attribute \"{}\" \"{}\"", group, p.name),
                        word, fmt::format("{}", fmt::join(row.words, ", ")),
                        fmt::format("it is taken for \"{}\"", row.words[0]));
}

void AttributeCalls::detail(const Call& call) {
    auto box = call.arguments[0].floats();
    state_.attributes.has_detail = box.size() == 6;
    for (size_t i = 0; i < 6 && i < box.size(); ++i)
        state_.attributes.detail_box[i] = double(box[i]);
}

// The area in pixels of the box that Detail gave decides; in a range of transition the nearer of
// both. Where no box was given all ranges are drawn.
void AttributeCalls::detail_range(const Call& call) {
    state_.attributes.in_detail_range = true;
    if (!state_.attributes.has_detail || !state_.in_world()) return;
    double low = double(call.arguments[0].real()), lower = double(call.arguments[1].real());
    double upper = double(call.arguments[2].real()), high = double(call.arguments[3].real());
    const std::array<double, 6>& box = state_.attributes.detail_box;
    PictureScale scale = state_.world->scale(state_.to_camera());
    dvec2 least(1e30), most(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
        dvec4 p = scale.to_camera * dvec4(box[corner & 1], box[2 + ((corner >> 1) & 1)],
                                          box[4 + ((corner >> 2) & 1)], 1);
        double z = scale.orthographic ? 1 : std::max(p.z, scale.near);
        dvec2 at = dvec2(p.x, p.y) * (scale.pixels / z);
        least = glm::min(least, at), most = glm::max(most, at);
    }
    double area = (most.x - least.x) * (most.y - least.y) * state_.options.relative_detail;
    state_.attributes.in_detail_range = area >= (low + lower) / 2 && area < (upper + high) / 2;
}

void AttributeCalls::orientation(const Call& call) {
    std::string_view side = call.arguments[0].string();
    bool left_handed = glm::determinant(state_.to_camera()) > 0;  // camera space is
    if (side == "outside")
        state_.attributes.inside_out = false;
    else if (side == "inside")
        state_.attributes.inside_out = true;
    else if (side == "lh")
        state_.attributes.inside_out = !left_handed;
    else
        state_.attributes.inside_out = left_handed;
}

void AttributeCalls::reverse_orientation(const Call&) {
    state_.attributes.inside_out = !state_.attributes.inside_out;
}

void AttributeCalls::sides(const Call& call) {
    int sides = call.arguments[0].integer();
    if (sides != 1 && sides != 2) return report_.add(Code::RI_RANGE, "Sides", "it is 1 or 2");
    state_.attributes.two_sided = sides == 2;
}

void AttributeCalls::basis(const Call& call) {
    std::optional<dmat4> u = basis_matrix(call.arguments[0]), v = basis_matrix(call.arguments[2]);
    if (!u || !v)
        return report_.add(Code::RI_RANGE, "Basis",
                           "it is bezier, b-spline, catmull-rom, hermite, power or 16 numbers");
    state_.attributes.u = {*u, uint32_t(std::max(call.arguments[1].integer(), 1))};
    state_.attributes.v = {*v, uint32_t(std::max(call.arguments[3].integer(), 1))};
}

void AttributeCalls::trim_curve(const Call& call) {
    std::string why;
    state_.attributes.trims = trim_loops(call, why);
    if (!why.empty()) report_.add(Code::RI_COUNTS, "TrimCurve", why);
}

}  // namespace kinora::ri
