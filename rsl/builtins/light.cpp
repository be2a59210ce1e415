// rsl/builtins/light.cpp: lights and illumination.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_light {

// The sum over the records of one set of what `term` makes of each: it gets the record and the sum
// so far. Lights more than 90 degrees from the axis add nothing. No axis: ambient records are
// visited, and they alone; else all others.
template <class Term>
V3 sum_of_lights(LowerCall& c, const V3& position, const V3* axis, Term&& term) {
    auto& e = c.e;
    Value set = c.lights.set_at(position);
    const bool ambient = axis == nullptr;
    if (axis) c.lights.look_about(set, axis);
    c.lights.look_at_all(ambient);
    std::array<Value, 3> sum = {e.f(0), e.f(0), e.f(0)};
    for_each_record(c.b, set, sum, c.where(), [&](Value record) {
        Value kind = record_uniform(c.b, set, record, kLightKind, jit::Type::I);
        Value is_ambient = c.b.op(jit::Op::IEq, kind, c.b.i(kLightAmbient));
        V3 before = {sum[0], sum[1], sum[2]};
        c.b.begin_if(ambient ? is_ambient : c.b.logical_not(is_ambient));
        V3 after = term(set, record, before);
        c.b.end_if();
        for (size_t k = 0; k < 3; ++k) sum[k] = c.b.merge(after[k], before[k]);
    });
    return sum;
}

// A dark record has Cl = 0, so no formula needs to ask whether it is lit.
void ambient(LowerCall& c) {
    c.set(sum_of_lights(c, c.globals.read(Global::P).v3(), nullptr,
                        [&](Value set, Value record, const V3& sum) {
                            return c.e.add(sum, record_triple(c.b, set, record, kLightCl));
                        }));
}

Value share(LowerCall& c, Value set, Value record, int field) {
    return c.b.sub(c.b.f(1), record_uniform(c.b, set, record, field, jit::Type::F));
}

// RI 3.2: the sum of Cl * max(0, normalize(L) . N). With an axis and an angle only lights within
// it.
void diffuse(LowerCall& c) {
    auto& e = c.e;
    bool cone = c.args.size() == 3;
    V3 N = c.v3(cone ? 1 : 0);
    V3 P = cone ? c.v3(0) : c.globals.read(Global::P).v3();
    Value limit = e.f(0);
    if (cone) {  // nothing lies outside half a turn or more
        Value all = c.b.le(e.f(3.14159f), c.f(2));
        Value cosine = c.b.select(all, e.f(-2), jit::math::cos(c.b, c.f(2), e.tier));
        limit = e.mul(cosine, e.length(N));
    }
    c.set(sum_of_lights(c, P, &N, [&](Value set, Value record, const V3& sum) {
        V3 L = e.normalize(record_triple(c.b, set, record, kLightL));
        Value cosine = e.dot(L, N);
        Value amount = c.b.max(cosine, e.f(0));
        if (cone) amount = c.b.select(c.b.lt(cosine, limit), e.f(0), amount);
        amount = e.mul(amount, share(c, set, record, kLightNondiffuse));
        return e.fma(record_triple(c.b, set, record, kLightCl), amount, sum);
    }));
}

// 8/roughness, as PRMan, BMRT and Aqsis have it: RI 3.2 calls its 1/roughness an example. What is
// not rough at all shines in one direction only, though 8/0 is 0.
Value exponent_of(LowerCall& c, Value roughness) {
    return c.e.div(c.e.f(8), c.b.max(roughness, c.e.f(kLeastRoughness)));
}

// pow(max(0, N . H), 8/roughness), H half-way between L and V.
Value specular_term(Emitter& e, const V3& L, const V3& N, const V3& V, Value exponent) {
    V3 H = e.normalize(e.add(L, V));
    return e.pow_positive(e.b.max(e.dot(N, H), e.f(0)), exponent);
}

void specular(LowerCall& c) {
    auto& e = c.e;
    V3 N = c.v3(0), V = c.v3(1);
    Value exponent = exponent_of(c, c.f(2));
    c.set(sum_of_lights(c, c.globals.read(Global::P).v3(), &N,
                        [&](Value set, Value record, const V3& sum) {
                            V3 L = e.normalize(record_triple(c.b, set, record, kLightL));
                            Value front = c.b.lt(e.f(0), e.dot(L, N));
                            Value amount = specular_term(e, L, N, V, exponent);
                            amount = c.b.select(front, amount, e.f(0));
                            amount = e.mul(amount, share(c, set, record, kLightNonspecular));
                            return e.fma(record_triple(c.b, set, record, kLightCl), amount, sum);
                        }));
}

// RI 3.2: pow(max(0, R . L), size), R the eye's mirror direction.
void phong(LowerCall& c) {
    auto& e = c.e;
    V3 N = c.v3(0), V = c.v3(1);
    V3 unit_N = e.normalize(N), unit_V = e.normalize(V);
    V3 R = e.fma(unit_N, e.mul(e.f(2), e.dot(unit_V, unit_N)), e.neg(unit_V));
    Value size = c.f(2);
    c.set(sum_of_lights(c, c.globals.read(Global::P).v3(), &N,
                        [&](Value set, Value record, const V3& sum) {
                            V3 L = e.normalize(record_triple(c.b, set, record, kLightL));
                            Value front = c.b.lt(e.f(0), e.dot(L, N));
                            Value base = c.b.max(e.dot(R, L), e.f(0));
                            Value amount = e.pow_positive(base, size);
                            amount = c.b.select(front, amount, e.f(0));
                            amount = e.mul(amount, share(c, set, record, kLightNonspecular));
                            return e.fma(record_triple(c.b, set, record, kLightCl), amount, sum);
                        }));
}

void specularbrdf(LowerCall& c) {
    auto& e = c.e;
    Value exponent = exponent_of(c, c.f(3));
    Value term = specular_term(e, e.normalize(c.v3(0)), c.v3(1), c.v3(2), exponent);
    c.set(V3{term, term, term});
}

// The light itself comes from functions that the call becomes (rsl/objects/integrators.h).
void hints_only(LowerCall& c) {
    c.report_unknown_pairs();
    c.set(V3{c.e.f(0), c.e.f(0), c.e.f(0)});
}

}  // namespace lower_light

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
    Number exponent = Number(8) / rsl::max(roughness, Number(Real(kLeastRoughness)));
    return rsl::pow(rsl::max(Number(0), dot(N, H)), exponent);
}

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
template <class Real>
void hints_only(RefCall<Real>& c) {
    c.set(Vec<Real>{});
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_light;

const Builtin kRows[] = {
    {"ambient", "c=", lower::ambient, KINORA_RSL_REF(ref::ambient), kLights | kVaryingResult, 2,
     "Sum of the ambient lights.", kSurface},
    {"diffuse", "c=n c=pnf", lower::diffuse, KINORA_RSL_REF(ref::diffuse), kLights | kVaryingResult,
     8, "Lambert reflection of all lights: sum of Cl * max(0, L . N).", kSurface, "P"},
    {"specular", "c=nvf", lower::specular, KINORA_RSL_REF(ref::specular), kLights | kVaryingResult,
     16,
     "Specular reflection of all lights: specular(N, V, roughness), with exponent 8 / roughness.",
     kSurface, "P"},
    {"phong", "c=nvf", lower::phong, KINORA_RSL_REF(ref::phong), kLights | kVaryingResult, 16,
     "Phong reflection of all lights: phong(N, V, size).", kSurface, "P"},
    {"specularbrdf", "c=vnvf", lower::specularbrdf, KINORA_RSL_REF(ref::specularbrdf), kPure, 16,
     "The term of specular() for one light: specularbrdf(L, N, V, roughness), with exponent "
     "8 / roughness."},
    {"directlighting", "c=~", lower::hints_only, KINORA_RSL_REF(ref::hints_only), kPure, 0,
     "RSL 2.0, in a class: directlighting(this, getlights(), ...), the light of one sample of each "
     "light, by the class's evaluateSamples(). Results are \"diffuseresult\", \"specularresult\" "
     "and \"irradianceresult\"; \"materialsamples\" receives the class's own samples.",
     kSurface},
    {"indirectspecular", "c=~", lower::hints_only, KINORA_RSL_REF(ref::hints_only), kPure, 0,
     "RSL 2.0, in a class: indirectspecular(this, ...), the mean of response / pdf times traced "
     "light over the class's generateSamples(), or over \"materialsamples\"; rays go as far as "
     "\"maxdist\".",
     kSurface},
};

}  // namespace

std::span<const Builtin> builtins_light() {
    return kRows;
}

}  // namespace kinora::rsl
