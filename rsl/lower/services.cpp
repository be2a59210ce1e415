// rsl/lower/services.cpp: inputs by name, calls of RendererServices, and random numbers.
#include "rsl/lower/services.h"

#include <algorithm>

#include "rsl/lower/values.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

Lowered named_input(jit::Builder& b, const std::string& name, BaseType type, jit::Rate rate,
                    const std::string& du_name, const std::string& dv_name) {
    Lowered result{type, {}};
    jit::Type t = type == BaseType::String ? jit::Type::I : jit::Type::F;
    auto derived = [&](const std::string& from, int c) {
        return from.empty() || from == "1" ? from : from + component_suffix(type, c);
    };
    for (int c = 0; c < result.size(); ++c)
        result.c[size_t(c)] = b.input(
            {name + component_suffix(type, c), t, rate, derived(du_name, c), derived(dv_name, c)});
    return result;
}

Value scalar_input(jit::Builder& b, const std::string& name, jit::Type type, jit::Rate rate) {
    return b.input({name, type, rate, "", ""});
}

bool is_input(jit::Builder& b, const V3& v, const char* name) {
    for (int c = 0; c < 3; ++c) {
        const jit::Inst* inst = &b.inst(v[size_t(c)]);
        if (inst->op == jit::Op::WithSlope) inst = &b.inst(inst->a);
        if (inst->op != jit::Op::Input) return false;
        if (b.module().inputs[size_t(inst->imm)].name !=
            name + component_suffix(BaseType::Point, c))
            return false;
    }
    return true;
}

namespace {

// Signatures as rsl/model/renderer_services.h lists them: i int, f float; p, v, n the three floats
// of a point, vector or normal in the kernel's "current". Directions into an environment map are
// numbers in the map's space.
struct ServiceRow {
    std::string_view name;
    std::string params;
    std::string results;
    bool pure;
};
const ServiceRow kServices[] = {
    {"lights", "p", "i", true},
    {"texture", "iffffffffffif", "ffff", true},
    {"environment", "iffffffffffff", "ffff", true},
    {"shadow", "ipvvfff", "fff", true},
    {"textureinfo", "ii", "iffffffffffffffff", true},
    {"trace", "iipvffffi", "ffff", true},
    {"transmission", "iippfff", "fff", true},
    {"occlusion", "iipnffffffi", "fvfff", true},
    {"indirectdiffuse", "iipnffffi", "ffffff", true},
    {"gather", "iiiipvffffii", "i", false},
    {"query", "iiiiii", "iffffffffffffffff", true},
    {"bake3d", "iii" + std::string(8 + kPointFloats, 'f'), "", false},
    {"texture3d", "iifffffff", "i" + std::string(kPointFloats, 'f'), true},
    {"photons", "iiipn", "fff", true},
    {"transform", "i", "ffffffffffffffffffffffff", true},
    {"print", "iffffffffffffffff", "", false},
    {"concat", "ii", "i", true},
    {"format", "iffffffffffffffff", "i", true},
    {"match", "ii", "f", true},
};

// What of a signature is a triple in space; Float: a number.
BaseType spatial(char letter) {
    return letter == 'p'   ? BaseType::Point
           : letter == 'v' ? BaseType::Vector
           : letter == 'n' ? BaseType::Normal
                           : BaseType::Float;
}

std::vector<jit::Type> types(std::string_view letters) {
    std::vector<jit::Type> result;
    for (char c : letters)
        result.insert(result.end(), size_t(component_count(spatial(c))),
                      c == 'i' ? jit::Type::I : jit::Type::F);
    return result;
}

// body(triple) for each triple among the values, which may change it.
template <class Body>
void for_each_triple(std::string_view letters, std::span<Value> values, Body&& body) {
    size_t at = 0;
    for (char c : letters) {
        Lowered x{spatial(c), {}};
        size_t width = size_t(x.size());
        if (is_spatial(x.type)) {
            std::copy_n(&values[at], width, x.c.begin());
            x = body(x);
            std::copy_n(x.c.begin(), width, &values[at]);
        }
        at += width;
    }
}

const ServiceRow& service_row(std::string_view name) {
    for (const ServiceRow& row : kServices)
        if (row.name == name) return row;
    CHECK(false);
    return kServices[0];
}

}  // namespace

std::vector<Value> kernel_service(Emitter& e, std::string_view name, std::span<const Value> args) {
    const ServiceRow& row = service_row(name);
    int slot =
        e.b.declare_service({std::string(name), types(row.params), types(row.results), row.pure});
    return e.b.service(slot, e.running, args);
}

std::vector<Value> Services::call(std::string_view name, std::span<const Value> args) {
    if (!context_.bends_normals()) return kernel_service(e_, name, args);
    const ServiceRow& row = service_row(name);
    int slot =
        e_.b.declare_service({std::string(name), types(row.params), types(row.results), row.pure});
    std::vector<Value> given(args.begin(), args.end());
    for_each_triple(row.params, given, [&](const Lowered& x) { return spaces_.out_of_layer(x); });
    std::vector<Value> answer = e_.b.service(slot, e_.running, given);
    for_each_triple(row.results, answer, [&](const Lowered& x) { return spaces_.into_layer(x); });
    return answer;
}

Value SampleSeeds::path_value() {
    if (state_.handed_in == jit::kNone) return b_.i(int32_t(state_.path));
    return b_.iadd(b_.imul(state_.handed_in, b_.i(int32_t(state_.factor))),
                   b_.i(int32_t(state_.path)));
}

SampleSeeds::Path SampleSeeds::enter_call(uint32_t site) {
    Path outer{state_.path, state_.factor};
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
    return {scalar_input(b_, "rng", jit::Type::I, jit::Rate::Point), seed};
}

// docs/decisions.md#random-numbers-without-state: a hash of the sample, the site of the call and
// the loop iterations.
Value SampleSeeds::random01(const CallExpr& call, int component) {
    context_.out.uses_rng = true;
    uint32_t site = call.site * 40503u + uint32_t(component);
    Value path = b_.imul(path_value(), b_.i(int32_t(2654435761u)));
    std::vector<Value> keys = {scalar_input(b_, "rng", jit::Type::I, jit::Rate::Point),
                               b_.ixor(path, b_.i(int32_t(site)))};
    keys.insert(keys.end(), state_.counters.begin(), state_.counters.end());
    return jit::math::hash01(b_, keys);
}

}  // namespace kinora::rsl
