// rsl/reference/light.cpp: built-ins over lights, messages, services and text, at one point.
#include <bit>
#include <regex>

#include "rsl/model/string_functions.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

// A parameter of the light of this turn of illuminance.
template <class Real>
std::vector<double> Reference<Real>::messages(std::string_view name, size_t count) const {
    if (!light) return {};
    if (count == 1 && name == "__nondiffuse") return {light->nondiffuse};
    if (count == 1 && name == "__nonspecular") return {light->nonspecular};
    for (auto& [known, numbers] : light->messages)
        if (known == name && numbers.size() == count) return numbers;
    return {};
}
template std::vector<double> Reference<float>::messages(std::string_view, size_t) const;
template std::vector<double> Reference<double>::messages(std::string_view, size_t) const;

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
    Number exponent = Number(1) / rsl::max(roughness, Number(Real(kLeastRoughness)));
    return rsl::pow(rsl::max(Number(0), dot(N, H)), exponent);
}

// Results of a service as a triple or float.
template <class Real>
void from_service(RefCall<Real>& c, const std::vector<double>& answer) {
    for (size_t k = 0; k < c.result.size(); ++k)
        c.result.c[k] = Real(k < answer.size() ? answer[k] : 0);
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

// What a map shows, and as its derivatives the differences to what it shows one footprint further
// along u and along v: `ask` is given how many footprints.
template <class Real, class Ask>
void from_map(RefCall<Real>& c, Ask&& ask) {
    std::vector<double> here = ask(Real(0), Real(0)), u = ask(Real(1), Real(0)),
                        v = ask(Real(0), Real(1));
    from_service(c, here);
    Real du = std::max(c.eval.global(Global::du).c[0].x, Real(1e-12f));
    Real dv = std::max(c.eval.global(Global::dv).c[0].x, Real(1e-12f));
    for (size_t k = 0; k < c.result.size() && k < here.size(); ++k) {
        c.result.c[k].u = (Real(u[k]) - Real(here[k])) / du;
        c.result.c[k].v = (Real(v[k]) - Real(here[k])) / dv;
    }
}

// Maps are asked without filter widths, the reference knows none; four corners by their middle.
template <class Real>
void texture(RefCall<Real>& c) {
    bool own = c.args.size() < 3, corners = c.args.size() == 9;
    Real du = c.eval.global(Global::du).c[0].x, dv = c.eval.global(Global::dv).c[0].x;
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    // Along x from corners 1, 3 to 2, 4; along y from 1, 2 to 3, 4.
    auto coordinate = [&](Global global, size_t k, Real x, Real y) {
        if (!corners) {
            Dual<Real> at = own ? c.eval.global(global).c[0] : c.f(k);
            return at.x + (at.u * du) * x + (at.v * dv) * y;
        }
        Real a = c.f(k).x, b = c.f(k + 2).x, d = c.f(k + 4).x, e = c.f(k + 6).x;
        return Real(0.25) * ((a + b) + (d + e)) + Real(0.5) * ((b - a) + (e - d)) * x +
               Real(0.5) * ((d - a) + (e - b)) * y;
    };
    from_map(c, [&](Real x, Real y) {
        return c.eval.service(Service::texture,
                              {double(c.f(0).x), channel, double(coordinate(Global::s, 1, x, y)),
                               double(coordinate(Global::t, 2, x, y))});
    });
}
// The point or direction of a map, or the middle of four.
template <class Real>
Vec<Real> middle(RefCall<Real>& c) {
    if (c.args.size() != 5) return c.v(1);
    return Dual<Real>(Real(0.25)) * ((c.v(1) + c.v(2)) + (c.v(3) + c.v(4)));
}
template <class Real>
bool is_scene(RefCall<Real>& c) {
    return c.text(0) == "raytrace" || c.text(0) == "reflection";
}
template <class Real>
void add_triple(std::vector<double>& args, const Vec<Real>& v) {
    for (auto& x : v) args.push_back(double(x.x));
}
template <class Real>
void environment(RefCall<Real>& c) {
    if (is_scene(c)) {  // the seed is not the reference's to know
        std::vector<double> args = {0, 0};
        add_triple(args, vec(c.eval.global(Global::P)));
        add_triple(args, middle(c));
        for (double x : {double(c.pair("maxdist", Real(1e30)).x), double(c.pair("bias", -1).x),
                         double(c.pair("samples", 1).x), double(c.pair("blur", 0).x), 0.0})
            args.push_back(x);
        return from_service(c, c.eval.service(Service::trace, args));
    }
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    Real du = c.eval.global(Global::du).c[0].x, dv = c.eval.global(Global::dv).c[0].x;
    bool corners = c.args.size() == 5;
    auto component = [&](size_t k, Real x, Real y) {
        Dual<Real> at = middle(c)[k];
        if (!corners) return at.x + (at.u * du) * x + (at.v * dv) * y;
        Real p = c.v(1)[k].x, q = c.v(2)[k].x, r = c.v(3)[k].x, s = c.v(4)[k].x;
        return at.x + Real(0.5) * ((q - p) + (s - r)) * x + Real(0.5) * ((r - p) + (s - q)) * y;
    };
    from_map(c, [&](Real x, Real y) {
        return c.eval.service(Service::environment,
                              {double(c.f(0).x), channel, double(component(0, x, y)),
                               double(component(1, x, y)), double(component(2, x, y))});
    });
}
// By rays to the light of this turn of illuminance, or of this light shader.
template <class Real>
void trace_shadow(RefCall<Real>& c) {
    Vec<Real> p = middle(c), L = vec(c.eval.global(Global::L)), to;
    Dual<Real> far(Real(1e15));
    if (c.eval.layer->shader->kind == ShaderKind::Light) {
        Vec<Real> Ps = vec(c.eval.global(Global::Ps));
        to = c.eval.in_solar ? Ps - far * rsl::normalize(L) : Ps - L;
    } else {
        if (!c.eval.light) return;
        to = c.eval.light->kind == kLightSolar ? p + far * L : p + L;
    }
    std::vector<double> args = {0, 0};
    add_triple(args, p);
    add_triple(args, to);
    args.push_back(double(c.pair("samples", 1).x));
    args.push_back(double(c.pair("blur", 0).x));
    args.push_back(double(c.pair("bias", -1).x));
    std::vector<double> through = c.eval.service(Service::transmission, args);
    for (double& x : through) x = 1 - x;
    if (c.result.type == BaseType::Float && through.size() == 3)
        through = {(through[0] + through[1] + through[2]) / 3};
    from_service(c, through);
}
template <class Real>
void shadow(RefCall<Real>& c) {
    if (is_scene(c)) return trace_shadow(c);
    Vec<Real> p = middle(c);
    from_service(c, c.eval.service(Service::shadow, {double(c.f(0).x), double(p[0].x),
                                                     double(p[1].x), double(p[2].x)}));
}

// The normal of P + h n for heights h of a map, whose slopes are differences over the footprint (J.
// F. Blinn, Simulation of Wrinkled Surfaces, 1978).
template <class Real>
void bump(RefCall<Real>& c) {
    using Number = Dual<Real>;
    bool placed = c.args.size() == 6;
    Number s = placed ? c.f(4) : c.eval.global(Global::s).c[0];
    Number t = placed ? c.f(5) : c.eval.global(Global::t).c[0];
    Real du = c.eval.global(Global::du).c[0].x, dv = c.eval.global(Global::dv).c[0].x;
    auto width = [&](const Number& x) {
        return std::max(std::fabs(x.u * du) + std::fabs(x.v * dv), Real(1.0 / 1024));
    };
    Real ds = width(s), dt = width(t);
    double channel = c.call.channel ? double(c.eval.expr(*c.call.channel).c[0].x) : 0;
    auto height = [&](Real by_s, Real by_t) {
        std::vector<double> texels = c.eval.service(
            Service::texture,
            {double(c.f(0).x), channel, double(s.x + by_s * ds), double(t.x + by_t * dt)});
        return texels.empty() ? Real(0) : Real(texels[0]);
    };
    Number slope_s = (height(Real(0.5), 0) - height(Real(-0.5), 0)) / ds;
    Number slope_t = (height(0, Real(0.5)) - height(0, Real(-0.5))) / dt;
    Vec<Real> N = c.v(1), n = rsl::normalize(N), along_s = c.v(2), along_t = c.v(3);
    Vec<Real> flat = c.eval.cross(along_s, along_t);
    Number side(Real(c.eval.decide(dot(flat, N).x < 0) ? -1 : 1));
    Vec<Real> terms = slope_s * cross(n, along_t) + slope_t * cross(along_s, n);
    Vec<Real> bent = rsl::length(flat) * n + side * terms;
    bool none = c.eval.decide(dot(bent, bent).x == 0);
    c.set(none ? N : rsl::length(N) * rsl::normalize(bent));
}

// The variable is set if the fact is known and fits: so many numbers, or one text (-1).
template <class Real>
void textureinfo(RefCall<Real>& c) {
    const Type type = c.call.args[2]->type;
    size_t each = size_t(component_count(type.base));
    std::vector<double> answer =
        c.eval.service(Service::textureinfo, {double(c.f(0).x), double(c.f(1).x)});
    bool text = type.base == BaseType::String;
    double count = answer.empty() ? 0 : answer[0];
    bool known = text ? count == -1 : count >= double(each);
    c.set(Dual<Real>(Real(known)));
    size_t numbers = text ? size_t(known) : count > 0 ? size_t(count) / each * each : 0;
    for (size_t k = 0; k < numbers && k + 1 < answer.size(); ++k) {
        if (type.is_array() && k / each >= c.arrays[2].size()) break;
        RefValue<Real>& item = type.is_array() ? c.arrays[2][k / each] : c.args[2];
        item.c[k % each] = Real(answer[1 + k]);
    }
}
template <class Real>
void bake(RefCall<Real>&) {}  // what is written is no value of the point

template <class Real>
void lightsource(RefCall<Real>& c) {
    const Type type = c.call.args[1]->type;
    size_t each = size_t(component_count(type.base)),
           length = std::max(c.arrays[1].size(), size_t(1));
    std::vector<double> found = c.eval.messages(c.text(0), each * length);
    c.set(Dual<Real>(Real(found.empty() ? 0 : 1)));
    for (size_t k = 0; k < found.size(); ++k) {
        RefValue<Real>& item = type.is_array() ? c.arrays[1][k / each] : c.args[1];
        item.c[k % each] = Real(found[k]);
    }
}
template <class Real>
void shadername(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(intern(c.args.empty() ? c.eval.layer->shader->name : ""))));
}
template <class Real>
void concat(RefCall<Real>& c) {
    std::string all;
    for (size_t i = 0; i < c.args.size(); ++i) all = limited_text(all + c.text(i));
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
    c.set(Dual<Real>(Real(intern(limited_text(format_text(c.text(0), values))))));
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
KINORA_RSL_DEFINE_REF(bump)
KINORA_RSL_DEFINE_REF(textureinfo)
KINORA_RSL_DEFINE_REF(bake)
KINORA_RSL_DEFINE_REF(lightsource)
KINORA_RSL_DEFINE_REF(shadername)
KINORA_RSL_DEFINE_REF(concat)
KINORA_RSL_DEFINE_REF(match)
KINORA_RSL_DEFINE_REF(format)
KINORA_RSL_DEFINE_REF(printf)

}  // namespace ref
}  // namespace kinora::rsl
