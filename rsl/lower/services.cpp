// rsl/lower/services.cpp: inputs by their keys, calls of RendererServices, and random numbers.
#include "rsl/lower/services.h"

#include <algorithm>

#include "rsl/lower/values.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

jit::InputInfo input_info(const KernelKey& key, jit::Type type, jit::Rate rate, Slopes slopes) {
    KernelKey du, dv;
    if (slopes == Slopes::Given)
        du = partial_key(key, Partial::Du), dv = partial_key(key, Partial::Dv);
    return {text(key), type, rate, text(du), text(dv), packed(key), packed(du), packed(dv)};
}

Value scalar_input(jit::Builder& b, const KernelKey& key, jit::Type type, jit::Rate rate) {
    return b.input(input_info(key, type, rate, Slopes::None));
}

Lowered global_input(jit::Builder& b, Global input, jit::Rate rate, Slopes slopes) {
    Lowered result{global_info(input).type.base, {}};
    for (int c = 0; c < result.size(); ++c)
        result.c[size_t(c)] = b.input(input_info(global_key(input, c), jit::Type::F, rate, slopes));
    return result;
}

Value rng_input(jit::Builder& b) {
    return scalar_input(b, plain_key(KeyKind::Rng), jit::Type::I, jit::Rate::Point);
}

bool is_input(jit::Builder& b, const V3& v, Global input) {
    for (int c = 0; c < 3; ++c) {
        const jit::Inst* inst = &b.inst(v[size_t(c)]);
        if (inst->op == jit::Op::WithSlope) inst = &b.inst(inst->a);
        if (inst->op != jit::Op::Input) return false;
        if (key_of(b.module().inputs[size_t(inst->imm)]) != global_key(input, c)) return false;
    }
    return true;
}

namespace {

BaseType spatial_type(char kind) {
    return kind == 'p' ? BaseType::Point : kind == 'v' ? BaseType::Vector : BaseType::Normal;
}

// Types of a list of rsl/model/services.def.
std::vector<jit::Type> types(std::string_view list) {
    std::vector<jit::Type> result;
    for_each_service_value(list, [&](const ServiceValue& value) {
        result.insert(result.end(), size_t(value.width()),
                      value.kind == 'i' ? jit::Type::I : jit::Type::F);
    });
    return result;
}

// moved(triple) in place of each point, vector and normal of a list.
template <class Moved>
void move_triples(std::string_view list, std::span<Value> numbers, Moved&& moved) {
    for_each_service_value(list, [&](const ServiceValue& value) {
        if (!value.is_spatial()) return;
        Lowered x{spatial_type(value.kind), {}};
        std::copy_n(&numbers[size_t(value.first)], 3, x.c.begin());
        x = moved(x);
        std::copy_n(x.c.begin(), 3, &numbers[size_t(value.first)]);
    });
}

}  // namespace

std::vector<Value> kernel_service(Emitter& e, Service service, std::span<const Value> args) {
    const ServiceForm& form = service_form(service);
    CHECK_EQ(args.size(), size_t(argument_count(service)));
    int slot = e.b.declare_service(
        {std::string(form.name), types(form.arguments), types(form.results), form.pure});
    return e.b.service(slot, e.running, args);
}

std::vector<Value> Services::call(Service service, std::span<const Value> args) {
    if (!context_.bends_normals()) return kernel_service(e_, service, args);
    const ServiceForm& form = service_form(service);
    std::vector<Value> given(args.begin(), args.end());
    move_triples(form.arguments, given, [&](const Lowered& x) { return spaces_.out_of_layer(x); });
    std::vector<Value> answer = kernel_service(e_, service, given);
    move_triples(form.results, answer, [&](const Lowered& x) { return spaces_.into_layer(x); });
    return answer;
}

Value SampleSeeds::path_value() {
    if (state_.handed_in == jit::kNone) return b_.i(int32_t(state_.path));
    return b_.iadd(b_.imul(state_.handed_in, b_.i(int32_t(state_.factor))),
                   b_.i(int32_t(state_.path)));
}

SampleSeeds::Path SampleSeeds::enter_call(uint32_t site, bool samples) {
    Path outer{state_.path, state_.factor, state_.stratifies};
    state_.stratifies |= samples;
    state_.path = state_.path * 31 + site + 1;
    state_.factor *= 31;
    return outer;
}

Value SampleSeeds::path_into(uint32_t site) {
    Value path = b_.iadd(b_.imul(path_value(), b_.i(31)), b_.i(int32_t(site + 1)));
    for (Value counter : state_.counters) path = b_.iadd(b_.imul(path, b_.i(31)), counter);
    return path;
}

std::array<Value, 2> SampleSeeds::sample(uint32_t site) {
    context_.out.uses_rng = true;
    Value path = b_.imul(path_value(), b_.i(int32_t(2654435761u)));
    Value seed = b_.ixor(path, b_.i(int32_t((site + 1) * 2246822519u)));
    for (Value counter : state_.counters)
        seed = b_.iadd(b_.imul(seed, b_.i(int32_t(747796405u))), b_.iadd(counter, b_.i(1)));
    return {rng_input(b_), seed};
}

SampleSeeds::Draw SampleSeeds::draw(uint32_t site) {
    const Value counter = state_.counters.empty() ? jit::kNone : state_.counters.back();
    const bool second =
        state_.open && state_.first_path == state_.path && state_.first_counter == counter;
    if (!second) state_.first_site = site;
    state_.first_path = state_.path;
    state_.first_counter = counter;
    state_.open = !second;
    Value path = b_.imul(path_value(), b_.i(int32_t(2654435761u)));
    Draw draw{b_.ixor(path, b_.i(int32_t((state_.first_site + 1) * 2246822519u))), b_.i(0), b_.i(1),
              second};
    for (size_t k = 0; k < state_.counters.size(); ++k) {
        const bool innermost = k + 1 == state_.counters.size();
        if (innermost && state_.turns[k] != jit::kNone) {
            draw.index = state_.counters[k];
            draw.count = state_.turns[k];
        } else {
            draw.sequence = b_.iadd(b_.imul(draw.sequence, b_.i(int32_t(747796405u))),
                                    b_.iadd(state_.counters[k], b_.i(1)));
        }
    }
    return draw;
}

// docs/decisions.md#random-numbers-without-state: a hash of the sample, the site of the call and
// the loop iterations.
Value SampleSeeds::random01(const CallExpr& call, int component) {
    context_.out.uses_rng = context_.out.draws_random = true;
    uint32_t site = call.site * 40503u + uint32_t(component);
    Value path = b_.imul(path_value(), b_.i(int32_t(2654435761u)));
    std::vector<Value> keys = {rng_input(b_), b_.ixor(path, b_.i(int32_t(site)))};
    keys.insert(keys.end(), state_.counters.begin(), state_.counters.end());
    return jit::math::hash01(b_, keys);
}

}  // namespace kinora::rsl
