// rsl/lower/services.cpp: calls of RendererServices, derivatives and random numbers.
#include "rsl/lower/lower_p.h"

namespace kinora::rsl {

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
void for_each_place(std::string_view letters, std::span<Value> values, Body&& body) {
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

}  // namespace

std::vector<Value> Lowering::service(std::string_view name, std::span<const Value> args) {
    for (const ServiceRow& row : kServices) {
        if (row.name != name) continue;
        int slot =
            b.declare_service({std::string(name), types(row.params), types(row.results), row.pure});
        if (!bends_normals()) return b.service(slot, running, args);
        std::vector<Value> given(args.begin(), args.end());
        for_each_place(row.params, given, [&](const Lowered& x) { return out_of_layer(x); });
        std::vector<Value> answer = b.service(slot, running, given);
        for_each_place(row.results, answer, [&](const Lowered& x) { return into_layer(x); });
        return answer;
    }
    CHECK(false);
    return {};
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
