// rsl/builtins/filterstep.cpp: a step, averaged over the width of the shading point.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/components_p.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_filterstep {

// The change of x across the shading point: |Du(x) du| + |Dv(x) dv|.
Value filter_width(LowerCall& c, Value x) {
    Value du = c.b.mul(c.b.op(jit::Op::Du, x), c.globals.read(Global::du).c[0]);
    Value dv = c.b.mul(c.b.op(jit::Op::Dv, x), c.globals.read(Global::dv).c[0]);
    return c.b.add(c.b.abs(du), c.b.abs(dv));
}

// The shares of the RI's filters that lie below u, -1 to 1 over their support: integrals of
// 1 - |x|, of exp(-2 x^2) (an odd polynomial, off by 2e-5 at most), and of Catmull and Rom's cubic.
Value below_box(LowerCall& c, Value u) {
    return c.b.fma(u, c.b.f(0.5f), c.b.f(0.5f));
}
Value below_triangle(LowerCall& c, Value u) {
    auto& b = c.b;
    return b.add(b.f(0.5f), b.mul(u, b.fma(b.abs(u), b.f(-0.5f), b.f(1))));
}
Value below_gaussian(LowerCall& c, Value u) {
    auto& b = c.b;
    constexpr float kOdd[] = {0.028227837f, -0.13371288f, 0.32582935f, -0.55624279f, 0.83589848f};
    Value square = b.mul(u, u), p = b.f(kOdd[0]);
    for (size_t k = 1; k < std::size(kOdd); ++k) p = b.fma(p, square, b.f(kOdd[k]));
    return b.fma(u, p, b.f(0.5f));
}
Value below_catmull_rom(LowerCall& c, Value u) {
    auto& b = c.b;
    Value a = b.abs(b.add(u, u));  // 0 to 2
    auto poly = [&](std::initializer_list<float> coefficients) {
        Value p = b.f(0);
        for (float k : coefficients) p = c.e.fma(p, a, b.f(k));
        return p;
    };
    Value inner = poly({0.375f, -2.5f / 3, 0, 1, 0});
    Value outer = poly({-0.125f, 2.5f / 3, -2, 2, -1.0f / 6});
    Value half = b.select(b.lt(a, b.f(1)), inner, outer);
    return b.add(b.f(0.5f), b.select(b.lt(u, b.f(0)), b.neg(half), half));
}
struct StepFilter {
    std::string_view name;
    Value (*below)(LowerCall& c, Value u);
};
constexpr StepFilter kStepFilters[] = {{"box", below_box},
                                       {"triangle", below_triangle},
                                       {"gaussian", below_gaussian},
                                       {"catmull-rom", below_catmull_rom}};

// Where none is named, and in place of one that is not known.
const StepFilter& filter_of(LowerCall& c) {
    if (!c.has_pair("filter")) return kStepFilters[0];
    const std::string* text = c.e.constant_text(c.text_pair("filter"));
    for (const StepFilter& filter : kStepFilters)
        if (text && filter.name == *text) return filter;
    c.context.report(Code::RSL_FILTER_UNKNOWN, c.where(), text ? *text : "", c.call.name);
    return kStepFilters[0];
}

Value filtered(LowerCall& c, Value share) {
    const StepFilter& filter = filter_of(c);
    if (filter.below == below_box) return share;
    Value u = c.e.clamp(c.b.fma(share, c.b.f(2), c.b.f(-1)), c.b.f(-1), c.b.f(1));
    return filter.below(c, u);
}

// The step averaged over a box: how much of [low, high] lies above the edge.
void filterstep(LowerCall& c) {
    c.report_unknown_pairs();
    auto& b = c.b;
    Value low = c.f(1), high = c.f(1);
    if (c.args.size() == 3) {
        low = b.min(c.f(1), c.f(2));
        high = b.max(c.f(1), c.f(2));
    }
    Value half = c.args.size() == 3 ? b.f(0) : b.mul(filter_width(c, c.f(1)), b.f(0.5f));
    // As in texture(), the one that names the direction counts where both are given.
    Value widen = c.has_pair("swidth") ? c.pair("swidth", 1) : c.pair("width", 1);
    if (c.args.size() == 3) {
        Value centre = b.mul(b.add(low, high), b.f(0.5f));
        half = b.mul(b.sub(high, low), b.f(0.5f));
        low = high = centre;
    }
    half = b.mul(half, widen);
    Value width = b.add(half, half);
    Value share = c.e.div(b.sub(b.add(high, half), c.f(0)), width);
    Value hard = b.select(b.lt(c.f(1), c.f(0)), b.f(0), b.f(1));
    Value soft = c.e.clamp(filtered(c, share), b.f(0), b.f(1));
    c.set(b.select(b.lt(width, b.f(1.17549435e-38f)), hard, soft));
}

}  // namespace lower_filterstep

namespace ref {
namespace {

// The RI's filters over -1..1.
double filter_at(std::string_view name, double x) {
    double a = std::fabs(x);
    if (name == "triangle") return 1 - a;
    if (name == "gaussian") return std::exp(-2 * x * x);
    if (name != "catmull-rom") return 1;
    a *= 2;
    return a < 1 ? 1.5 * a * a * a - 2.5 * a * a + 1 : -0.5 * a * a * a + 2.5 * a * a - 4 * a + 2;
}

// Below u, by the middle of small steps.
double share_below(std::string_view name, double u) {
    constexpr int kSteps = 4000;
    double below = 0, all = 0;
    for (int k = 0; k < kSteps; ++k) {
        double x = (2 * k + 1.0) / kSteps - 1, f = filter_at(name, x);
        all += f;
        if (x < u) below += f;
    }
    return below / all;
}

// The share of the interval s1..s2 (or of the width of s around it) that lies beyond the edge.
template <class Real>
void filterstep(RefCall<Real>& c) {
    using Number = Dual<Real>;
    Number s = c.f(1), low, high;
    if (c.args.size() == 3) {
        low = rsl::min(s, c.f(2)), high = rsl::max(s, c.f(2));
    } else {
        Real width = std::fabs(s.u * c.eval.global(Global::du).c[0].x) +
                     std::fabs(s.v * c.eval.global(Global::dv).c[0].x);
        low = s - Number(width / 2), high = s + Number(width / 2);
    }
    Number middle = Real(0.5) * (low + high);
    bool apart = false;  // "swidth" counts before "width"
    for (auto& [name, value] : c.pairs) apart = apart || name == "swidth";
    Number half = Real(0.5) * (high - low) * c.pair(apart ? "swidth" : "width", 1);
    low = middle - half, high = middle + half;
    Number edge = c.f(0);
    if ((high - low).x < Real(FLT_MIN)) return c.set(whole(c, Real(s.x < edge.x ? 0 : 1)));
    Number share = (high - edge) / (high - low);
    for (auto& [name, value] : c.pairs)
        if (name == "filter" && value.text() != "box")
            share = Number(Real(share_below(value.text(), double(2 * share.x - 1))));
    c.set(rsl::clamp(share, Number(0), Number(1)));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_filterstep;

const Builtin kRows[] = {
    {"filterstep", "f=ff~ f=fff~", lower::filterstep, KINORA_RSL_REF(ref::filterstep), kDerivative,
     4,
     "step filtered over the width of s, or from s1 to s2: filterstep(edge, s1 [, s2]); \"filter\" "
     "box (if none is named) triangle gaussian catmull-rom, \"width\" or, before it, \"swidth\".",
     kSurface | kDisplacement | kVolume},
};

}  // namespace

std::span<const Builtin> builtins_filterstep() {
    return kRows;
}

}  // namespace kinora::rsl
