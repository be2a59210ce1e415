// rsl/reference_light.cpp: built-ins over lights, messages, services and text, at one point.
#include <bit>
#include <regex>

#include "rsl/reference_p.h"
#include "rsl/string_functions.h"

namespace kinora::rsl {

// A parameter of the light of this turn of illuminance; empty if it has none of that name.
template <class Real>
auto Reference<Real>::messages(std::string_view name) -> std::vector<Item> {
    if (!light) return {};
    if (name == "__nondiffuse") return {{BaseType::Float, Number(Real(light->nondiffuse))}};
    if (name == "__nonspecular") return {{BaseType::Float, Number(Real(light->nonspecular))}};
    auto found = light->messages.find(std::string(name));
    if (found == light->messages.end()) return {};
    Item value(found->second.size() == 3 ? BaseType::Color : BaseType::Float);
    for (size_t k = 0; k < value.size(); ++k) value.c[k] = Real(found->second[k]);
    return {value};
}
template std::vector<RefValue<float>> Reference<float>::messages(std::string_view);
template std::vector<RefValue<double>> Reference<double>::messages(std::string_view);

namespace ref {

namespace {

template <class Real>
Vec<Real> color_of(const std::array<double, 3>& c) {
    return {Dual<Real>(Real(c[0])), Dual<Real>(Real(c[1])), Dual<Real>(Real(c[2]))};
}

// Sum over the lights within `angle` of N of Cl * weight(L normalised).
template <class Real, class F>
void sum_lights(RefCall<Real>& c, const Vec<Real>& N, double ReferenceLight::*off, F weight,
                Dual<Real> angle = Dual<Real>(Real(1.57079632679))) {
    Vec<Real> sum{};
    if (!(rsl::length(N).x > 0)) return c.set(sum);  // faces nothing
    c.eval.for_each_light(&N, angle, [&](const ReferenceLight& light, const Vec<Real>& L) {
        Dual<Real> k = weight(rsl::normalize(L));
        k = Real(1 - light.*off) * k;
        sum = sum + k * color_of<Real>(light.Cl);
    });
    c.set(sum);
}

template <class Real>
Dual<Real> highlight(const Vec<Real>& L, const Vec<Real>& N, const Vec<Real>& V,
                     const Dual<Real>& roughness) {
    using Number = Dual<Real>;
    Vec<Real> H = rsl::normalize(L + V);
    return rsl::pow(rsl::max(Number(0), dot(N, H)), Number(1) / roughness);
}

// Results of a service as a triple or float.
template <class Real>
void from_service(RefCall<Real>& c, const std::vector<double>& answer) {
    for (size_t k = 0; k < c.result.size(); ++k)
        c.result.c[k] = Real(k < answer.size() ? answer[k] : 0);
}
template <class Real>
void find_message(RefCall<Real>& c, const std::vector<RefValue<Real>>& found) {
    c.set(Dual<Real>(Real(found.empty() ? 0 : 1)));
    if (!found.empty()) c.args[1].c = found[0].c;
}

}  // namespace

template <class Real>
void ambient(RefCall<Real>& c) {
    Vec<Real> sum{};
    for (const ReferenceLight& light : c.eval.in.lights)
        if (light.kind == kLightAmbient) sum = sum + color_of<Real>(light.Cl);
    c.set(sum);
}

// RenderMan Interface 3.2, section 15: N and V are expected to have length 1; phong() sees to it.
template <class Real>
void diffuse(RefCall<Real>& c) {
    bool cone = c.args.size() == 3;
    Vec<Real> N = c.v(cone ? 1 : 0);
    auto weight = [&](const Vec<Real>& L) { return rsl::max(Dual<Real>(0), dot(L, N)); };
    if (cone)
        sum_lights(c, N, &ReferenceLight::nondiffuse, weight, c.f(2));
    else
        sum_lights(c, N, &ReferenceLight::nondiffuse, weight);
}
template <class Real>
void specular(RefCall<Real>& c) {
    Vec<Real> N = c.v(0), V = c.v(1);
    sum_lights(c, N, &ReferenceLight::nonspecular,
               [&](const Vec<Real>& L) { return highlight(L, N, V, c.f(2)); });
}
template <class Real>
void phong(RefCall<Real>& c) {
    Vec<Real> N = rsl::normalize(c.v(0)), V = rsl::normalize(c.v(1));
    Vec<Real> R = (Real(2) * dot(V, N)) * N - V;
    sum_lights(c, N, &ReferenceLight::nonspecular, [&](const Vec<Real>& L) {
        return rsl::pow(rsl::max(Dual<Real>(0), dot(R, L)), c.f(2));
    });
}
template <class Real>
void specularbrdf(RefCall<Real>& c) {
    Dual<Real> k = highlight(rsl::normalize(c.v(0)), c.v(1), c.v(2), c.f(3));
    c.set({k, k, k});
}

// Maps are asked without filter widths, the reference knows no footprint; four corners by their
// middle.
template <class Real>
void texture(RefCall<Real>& c) {
    bool own = c.args.size() < 3;
    Dual<Real> at_s = own ? c.eval.global(Global::s).c[0] : c.f(1);
    Dual<Real> at_t = own ? c.eval.global(Global::t).c[0] : c.f(2);
    if (c.args.size() == 9) {
        at_s = Real(0.25) * ((c.f(1) + c.f(3)) + (c.f(5) + c.f(7)));
        at_t = Real(0.25) * ((c.f(2) + c.f(4)) + (c.f(6) + c.f(8)));
    }
    double s = double(at_s.x), t = double(at_t.x);
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    from_service(c, c.eval.service("texture", {double(c.f(0).x), channel, s, t}));
}
// The point or direction of a map, or the middle of four.
template <class Real>
Vec<Real> middle(RefCall<Real>& c) {
    if (c.args.size() != 5) return c.v(1);
    return Dual<Real>(Real(0.25)) * ((c.v(1) + c.v(2)) + (c.v(3) + c.v(4)));
}
template <class Real>
void environment(RefCall<Real>& c) {
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    Vec<Real> R = middle(c);
    from_service(c, c.eval.service("environment", {double(c.f(0).x), channel, double(R[0].x),
                                                   double(R[1].x), double(R[2].x)}));
}
template <class Real>
void shadow(RefCall<Real>& c) {
    Vec<Real> p = middle(c);
    from_service(c, c.eval.service("shadow", {double(c.f(0).x), double(p[0].x), double(p[1].x),
                                              double(p[2].x)}));
}

template <class Real>
void lightsource(RefCall<Real>& c) {
    find_message(c, c.eval.messages(c.text(0)));
}
template <class Real>
void shadername(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(intern(c.args.empty() ? c.eval.layer->shader->name : ""))));
}
template <class Real>
void concat(RefCall<Real>& c) {
    std::string all;
    for (size_t i = 0; i < c.args.size(); ++i) all += c.text(i);
    c.set(Dual<Real>(Real(intern(all))));
}
template <class Real>
void match(RefCall<Real>& c) {
    bool found = std::regex_search(c.text(1), std::regex(c.text(0), std::regex::extended));
    c.set(Dual<Real>(Real(found)));
}
template <class Real>
void format(RefCall<Real>& c) {
    std::vector<float> values;
    for (size_t i = 1; i < c.args.size(); ++i) {
        const RefValue<Real>& value = c.args[i];
        for (size_t k = 0; k < value.size(); ++k)
            values.push_back(value.type == BaseType::String
                                 ? std::bit_cast<float>(int32_t(value.c[k].x))
                                 : float(value.c[k].x));
    }
    c.set(Dual<Real>(Real(intern(format_text(c.text(0), values)))));
}
template <class Real>
void printf(RefCall<Real>&) {}  // what is printed is no value of the point

KINORA_RSL_DEFINE_REF(ambient)
KINORA_RSL_DEFINE_REF(diffuse)
KINORA_RSL_DEFINE_REF(specular)
KINORA_RSL_DEFINE_REF(phong)
KINORA_RSL_DEFINE_REF(specularbrdf)
KINORA_RSL_DEFINE_REF(texture)
KINORA_RSL_DEFINE_REF(environment)
KINORA_RSL_DEFINE_REF(shadow)
KINORA_RSL_DEFINE_REF(lightsource)
KINORA_RSL_DEFINE_REF(shadername)
KINORA_RSL_DEFINE_REF(concat)
KINORA_RSL_DEFINE_REF(match)
KINORA_RSL_DEFINE_REF(format)
KINORA_RSL_DEFINE_REF(printf)

}  // namespace ref
}  // namespace kinora::rsl
