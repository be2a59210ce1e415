// rsl/lower/services.cpp: calls of RendererServices, derivatives and random numbers.
#include "rsl/lower/lower_p.h"

namespace kinora::rsl {

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

std::vector<Value> Lowering::service(Service service, std::span<const Value> args) {
    const ServiceForm& form = service_form(service);
    CHECK_EQ(args.size(), size_t(argument_count(service)));
    int slot = b.declare_service(
        {std::string(form.name), types(form.arguments), types(form.results), form.pure});
    if (!bends_normals()) return b.service(slot, running, args);
    std::vector<Value> given(args.begin(), args.end());
    move_triples(form.arguments, given, [&](const Lowered& x) { return out_of_layer(x); });
    std::vector<Value> answer = b.service(slot, running, given);
    move_triples(form.results, answer, [&](const Lowered& x) { return into_layer(x); });
    return answer;
}

V3 Lowering::du(const V3& v) {
    return {b.op(jit::Op::Du, v[0]), b.op(jit::Op::Du, v[1]), b.op(jit::Op::Du, v[2])};
}
V3 Lowering::dv(const V3& v) {
    return {b.op(jit::Op::Dv, v[0]), b.op(jit::Op::Dv, v[1]), b.op(jit::Op::Dv, v[2])};
}

std::array<Value, 2> Lowering::sample_seed(uint32_t site) {
    out.uses_rng = true;
    Value path = b.imul(path_value(), b.i(int32_t(2654435761u)));
    Value seed = b.ixor(path, b.i(int32_t((site + 1) * 2246822519u)));
    for (Value counter : loop_counters)
        seed = b.iadd(b.imul(seed, b.i(int32_t(747796405u))), b.iadd(counter, b.i(1)));
    return {scalar_input("rng", jit::Type::I, jit::Rate::Point), seed};
}

// docs/decisions.md#random-numbers-without-state: a hash of the sample, the place of the call and
// the loop iterations.
Value Lowering::random01(const CallExpr& call, int component) {
    out.uses_rng = true;
    uint32_t site = call.site * 40503u + uint32_t(component);
    Value path = b.imul(path_value(), b.i(int32_t(2654435761u)));
    std::vector<Value> keys = {scalar_input("rng", jit::Type::I, jit::Rate::Point),
                               b.ixor(path, b.i(int32_t(site)))};
    keys.insert(keys.end(), loop_counters.begin(), loop_counters.end());
    return jit::math::hash01(b, keys);
}

}  // namespace kinora::rsl
