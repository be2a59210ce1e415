// jit/passes/derivative_rules.cpp: forward-mode rules, one function a row.
#include "jit/passes/derivative_rules_p.h"

#include <limits>

#include "jit/math/math.h"

namespace kinora::jit {

namespace {

// Arithmetic in which kNone is zero.
Dual plus(Builder& b, Dual x, Dual y) {
    if (x == kNone) return y;
    return y == kNone ? x : b.add(x, y);
}
Dual minus(Builder& b, Dual x) {
    return x == kNone ? kNone : b.neg(x);
}
Dual minus(Builder& b, Dual x, Dual y) {
    if (y == kNone) return x;
    return x == kNone ? b.neg(y) : b.sub(x, y);
}
Dual times(Builder& b, Dual x, Value factor) {
    return x == kNone ? kNone : b.mul(x, factor);
}
// x * factor + rest
Dual fma(Builder& b, Dual x, Value factor, Dual rest) {
    if (x == kNone) return rest;
    return rest == kNone ? b.mul(x, factor) : b.fma(x, factor, rest);
}
Dual choose(Builder& b, Value mask, Dual x, Dual y) {
    if (x == kNone && y == kNone) return kNone;
    return b.select(mask, x == kNone ? b.f(0) : x, y == kNone ? b.f(0) : y);
}

// Ops, by the table below.

Dual d_add(const RuleSite& s) {
    return plus(s.b, s.dx[0], s.dx[1]);
}
Dual d_sub(const RuleSite& s) {
    return minus(s.b, s.dx[0], s.dx[1]);
}
Dual d_mul(const RuleSite& s) {
    return fma(s.b, s.dx[0], s.x[1], times(s.b, s.dx[1], s.x[0]));
}
// (x / y)' = (x' - r y') / y
Dual d_div(const RuleSite& s) {
    Dual top = fma(s.b, s.dx[1], s.b.neg(s.r), s.dx[0]);
    return top == kNone ? kNone : s.b.div(top, s.x[1]);
}
Dual d_fma(const RuleSite& s) {
    return fma(s.b, s.dx[0], s.x[1], fma(s.b, s.dx[1], s.x[0], s.dx[2]));
}
Dual d_min(const RuleSite& s) {
    return choose(s.b, s.b.lt(s.x[0], s.x[1]), s.dx[0], s.dx[1]);
}
Dual d_max(const RuleSite& s) {
    return choose(s.b, s.b.gt(s.x[0], s.x[1]), s.dx[0], s.dx[1]);
}
Dual d_neg(const RuleSite& s) {
    return minus(s.b, s.dx[0]);
}
Dual d_abs(const RuleSite& s) {
    return choose(s.b, s.b.lt(s.x[0], s.b.f(0)), minus(s.b, s.dx[0]), s.dx[0]);
}
// x' / (2 r); 0 where the root is 0, so that a normalised null vector stays finite.
Dual d_sqrt(const RuleSite& s) {
    Dual half = times(s.b, s.dx[0], s.b.f(0.5f));
    return half == kNone ? kNone : choose(s.b, s.b.gt(s.r, s.b.f(0)), s.b.div(half, s.r), kNone);
}
Dual d_select(const RuleSite& s) {
    return choose(s.b, s.x[0], s.dx[1], s.dx[2]);
}

struct OpRule {
    Op op;
    Dual (*rule)(const RuleSite& site);
};
// What is not here (rounding, conversions, loads) has derivative 0.
constexpr OpRule kOpRules[] = {
    {Op::Add, d_add}, {Op::Sub, d_sub},   {Op::Mul, d_mul},       {Op::Div, d_div},
    {Op::Fma, d_fma}, {Op::Min, d_min},   {Op::Max, d_max},       {Op::Neg, d_neg},
    {Op::Abs, d_abs}, {Op::Sqrt, d_sqrt}, {Op::Select, d_select},
};

// Functions.

struct Site {
    Builder& b;
    math::Tier tier;
    std::span<const Value> x;
    std::span<const Dual> dx;
    Value r;
    Value f(float value) const { return b.f(value); }
};

Dual d_sin(const Site& s) {
    return times(s.b, s.dx[0], math::cos(s.b, s.x[0], s.tier));
}
Dual d_cos(const Site& s) {
    return minus(s.b, times(s.b, s.dx[0], math::sin(s.b, s.x[0], s.tier)));
}
Dual d_tan(const Site& s) {
    return times(s.b, s.dx[0], s.b.fma(s.r, s.r, s.f(1)));
}
// 1 / sqrt(1 - x^2), which inversesqrt makes 0 at the ends, where the argument is clamped.
Dual d_asin(const Site& s) {
    Value root = math::inversesqrt(s.b, s.b.fma(s.b.neg(s.x[0]), s.x[0], s.f(1)), s.tier);
    return times(s.b, s.dx[0], root);
}
Dual d_acos(const Site& s) {
    return minus(s.b, d_asin(s));
}
Dual d_atan(const Site& s) {
    return s.b.div(s.dx[0], s.b.fma(s.x[0], s.x[0], s.f(1)));
}
// (x y' - y x') / (x^2 + y^2), 0 at the origin; arguments are (y, x).
Dual d_atan2(const Site& s) {
    Value y = s.x[0], x = s.x[1];
    Dual top = fma(s.b, s.dx[0], x, minus(s.b, times(s.b, s.dx[1], y)));
    Value square = s.b.fma(x, x, s.b.mul(y, y));
    return choose(s.b, s.b.gt(square, s.f(0)), s.b.div(top, square), kNone);
}
Dual d_exp(const Site& s) {
    return times(s.b, s.dx[0], s.r);
}
constexpr float kLn2 = 0.69314718055994531f;
Dual d_exp2(const Site& s) {
    return times(s.b, s.dx[0], s.b.mul(s.r, s.f(kLn2)));
}
// Constant below the smallest normal float, as the functions are.
Dual d_log_scaled(const Site& s, float scale) {
    Value above = s.b.ge(s.x[0], s.f(std::numeric_limits<float>::min()));
    return choose(s.b, above, s.b.div(s.b.mul(s.dx[0], s.f(scale)), s.x[0]), kNone);
}
Dual d_log(const Site& s) {
    return d_log_scaled(s, 1.0f);
}
Dual d_log2(const Site& s) {
    return d_log_scaled(s, 1.0f / kLn2);
}
// r (y' log x + y x' / x) for x > 0
Dual d_pow(const Site& s) {
    Value x = s.x[0], y = s.x[1];
    Dual sum = s.dx[0] == kNone ? kNone : s.b.div(s.b.mul(y, s.dx[0]), x);
    if (s.dx[1] != kNone) sum = fma(s.b, s.dx[1], math::log(s.b, x, s.tier), sum);
    return choose(s.b, s.b.gt(x, s.f(0)), s.b.mul(s.r, sum), kNone);
}
Dual d_inversesqrt(const Site& s) {
    Value cube = s.b.mul(s.b.mul(s.r, s.r), s.b.mul(s.r, s.f(-0.5f)));
    return times(s.b, s.dx[0], cube);
}

struct FunctionRule {
    std::string_view base;
    Dual (*rule)(const Site& site);
};
constexpr FunctionRule kFunctionRules[] = {
    {"sin", d_sin},
    {"cos", d_cos},
    {"tan", d_tan},
    {"asin", d_asin},
    {"acos", d_acos},
    {"atan", d_atan},
    {"exp", d_exp},
    {"atan2", d_atan2},
    {"exp2", d_exp2},
    {"log", d_log},
    {"log2", d_log2},
    {"pow", d_pow},
    {"inversesqrt", d_inversesqrt},
};

// "sin.p" -> the row of sin.
const FunctionRule* find_rule(std::string_view name) {
    if (!name.ends_with(".p") && !name.ends_with(".f")) return nullptr;
    for (const FunctionRule& row : kFunctionRules)
        if (row.base == name.substr(0, name.size() - 2)) return &row;
    return nullptr;
}

}  // namespace

Dual differentiate_op(const RuleSite& site) {
    for (const OpRule& row : kOpRules)
        if (row.op == site.op) return row.rule(site);
    return kNone;
}

bool has_function_rule(std::string_view name) {
    return find_rule(name) != nullptr;
}

Dual differentiate_function(Builder& b, std::string_view name, std::span<const Value> x,
                            std::span<const Dual> dx, Value r) {
    bool any = false;
    for (Dual d : dx) any |= d != kNone;
    if (!any) return kNone;
    auto tier = name.ends_with(".p") ? math::Tier::Precise : math::Tier::Fast;
    return find_rule(name)->rule({b, tier, x, dx, r});
}

}  // namespace kinora::jit
