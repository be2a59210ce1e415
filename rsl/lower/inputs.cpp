// rsl/lower/inputs.cpp: the kernel's inputs: globals and parameters by the names that
// rsl/model/renderer_services.h gives them.
#include "rsl/lower/lower_p.h"

namespace kinora::rsl {

std::string component_suffix(BaseType type, int component) {
    static const char* const kPoint[] = {".x", ".y", ".z"};
    static const char* const kColor[] = {".r", ".g", ".b"};
    if (type == BaseType::Color) return kColor[component];
    if (is_triple(type)) return kPoint[component];
    if (type == BaseType::Matrix) return "." + std::to_string(component);
    return "";
}

namespace {

// Globals that are inputs of surfaces, with the inputs that hold their derivatives. "1" is an input
// that is 1 everywhere.
struct GlobalInput {
    Global id;
    const char* name;
    const char* du;
    const char* dv;
    jit::Rate rate = jit::Rate::Point;
};
const GlobalInput kInputs[] = {
    {Global::P, "P", "dPdu", "dPdv"},
    {Global::dPdu, "dPdu", "", ""},
    {Global::dPdv, "dPdv", "", ""},
    {Global::N, "N", "dNdu", "dNdv"},
    {Global::Ng, "Ng", "", ""},
    {Global::I, "I", "dIdu", "dIdv"},
    {Global::u, "u", "1", ""},
    {Global::v, "v", "", "1"},
    {Global::du, "du", "", ""},
    {Global::dv, "dv", "", ""},
    {Global::s, "s", "dsdu", "dsdv"},
    {Global::t, "t", "dtdu", "dtdv"},
    {Global::Ps, "P", "dPdu", "dPdv"},
    {Global::Ns, "N", "dNdu", "dNdv"},
    {Global::E, "E", "", "", jit::Rate::Frame},
    {Global::time, "time", "", "", jit::Rate::Frame},
    {Global::dtime, "dtime", "", "", jit::Rate::Frame},
};
// Those of lights: the rest is 0, but see light_global().
const GlobalInput kLightInputs[] = {
    {Global::Ps, "Ps", "", ""},
    {Global::Ns, "Ns", "", ""},
    {Global::N, "Ns", "", ""},
    {Global::E, "E", "", "", jit::Rate::Frame},
    {Global::time, "time", "", "", jit::Rate::Frame},
    {Global::dtime, "dtime", "", "", jit::Rate::Frame},
};

// Those of lights on geometry, at the sample; u, v and what is along them are the mesh's.
const GlobalInput kAreaInputs[] = {
    {Global::P, "P", "", ""},       {Global::N, "N", "", ""},       {Global::Ng, "Ng", "", ""},
    {Global::dPdu, "dPdu", "", ""}, {Global::dPdv, "dPdv", "", ""}, {Global::u, "u", "", ""},
    {Global::v, "v", "", ""},       {Global::s, "s", "", ""},       {Global::t, "t", "", ""},
};

// Globals with a first value that no input gives.
struct GlobalConstant {
    Global id;
    float value;
};
const GlobalConstant kConstants[] = {
    {Global::Cs, 1},    {Global::Os, 1}, {Global::ncomps, 3},
    {Global::alpha, 1}, {Global::Oi, 1}, {Global::PI, 3.14159265358979f},
};

}  // namespace

Lowered Lowering::input(const std::string& name, BaseType type, jit::Rate rate,
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

Value Lowering::scalar_input(const std::string& name, jit::Type type, jit::Rate rate) {
    return b.input({name, type, rate, "", ""});
}

bool Lowering::is_input(const V3& v, const char* name) {
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

// For displacements that only bend normals: P whose slopes lie in the plane that N is normal to,
// not in that of the face. What calculatenormal() makes of it is N bent, and shows no faces.
Lowered Lowering::smooth_P(const Lowered& N) {
    auto fixed = [&](const V3& v) {  // without slopes of its own
        return V3{b.op(jit::Op::WithSlope, v[0], b.f(0)), b.op(jit::Op::WithSlope, v[1], b.f(0)),
                  b.op(jit::Op::WithSlope, v[2], b.f(0))};
    };
    V3 P = global_input(Global::P).v3();
    V3 n = fixed(normalize(N.v3()));
    V3 way{b.f(0), b.f(0), b.f(0)};  // its slopes are those of P
    for (auto [edge, along] :
         {std::pair(Global::dPdu, Global::u), std::pair(Global::dPdv, Global::v)}) {
        V3 d = global_input(edge).v3();
        d = fixed(sub(d, scale(n, dot(n, d))));
        way = fma(d, global_input(along).c[0], way);
    }
    for (size_t c = 0; c < 3; ++c) P[c] = b.op(jit::Op::WithSlope, P[c], way[c]);
    return lowered(BaseType::Point, P);
}

V3 Lowering::normal_of(const V3& p) {
    V3 normal = cross(du(p), dv(p));
    V3 own = cross(global_input(Global::dPdu).v3(), global_input(Global::dPdv).v3());
    Value against = b.lt(dot(own, global_input(Global::Ng).v3()), f(0));
    V3 value = select(against, neg(normal), normal), N = global_input(Global::N).v3();
    for (size_t k = 0; k < 3; ++k) value[k] = b.op(jit::Op::WithSlope, value[k], N[k]);
    return value;
}

// What a light sees of itself: it stands at the origin of its space.
static Lowered light_global(Lowering& low, const GlobalInfo& info) {
    if (info.id == Global::P) {
        V3 origin;
        for (int r = 0; r < 3; ++r)
            origin[size_t(r)] =
                low.scalar_input("space:shader:to_current:" + std::to_string(r) + "3", jit::Type::F,
                                 jit::Rate::Frame);
        return lowered(BaseType::Point, origin);
    }
    if (info.id == Global::I) {
        V3 ps = low.read_global(Global::Ps).v3();
        return lowered(BaseType::Vector, low.sub(ps, low.read_global(Global::E).v3()));
    }
    return low.zero(info.type.base);
}

// Normals of length 1 stay so in the object's space: true displacement hands those.
Lowered Lowering::global_input(Global id) {
    Lowered x = kernel_input(id);
    if (!bends_normals() || !is_spatial(x.type)) return x;
    x = into_layer(x);
    return x.type == BaseType::Normal ? lowered(x.type, normalize(x.v3())) : x;
}

Lowered Lowering::kernel_input(Global id) {
    const GlobalInfo& info = global_info(id);
    BaseType type = info.type.base;
    bool light = kind() == ShaderKind::Light;
    if (!((info.readers | info.writers) & in_kind(kind()))) return zero(type);  // warned of
    if (const ParamBinding* bound = binding(info.name)) {                       // a bound Cs or Os
        if (bound->kind != ParamBinding::Kind::Default)
            return bound_value(*bound, info.name, {type, -1}, 0);
    }
    bool behind = kind() == ShaderKind::Volume || kind() == ShaderKind::Imager;
    if (behind && (id == Global::Ci || id == Global::Oi))
        return input(std::string(info.name), type, jit::Rate::Point);
    if (kind() == ShaderKind::Imager && id == Global::alpha)
        return input("alpha", type, jit::Rate::Point);
    if (light && options.area_light)
        for (const GlobalInput& row : kAreaInputs)
            if (row.id == id) return input(row.name, type, row.rate, row.du, row.dv);
    auto rows =
        light ? std::span<const GlobalInput>(kLightInputs) : std::span<const GlobalInput>(kInputs);
    for (const GlobalInput& row : rows)
        if (row.id == id) return input(row.name, type, row.rate, row.du, row.dv);
    for (const GlobalConstant& row : kConstants)
        if (row.id == id) return convert(lowered(BaseType::Float, b.f(row.value)), type);
    return light ? light_global(*this, info) : zero(type);
}

// ---- parameters ---------------------------------------------------------------------------------

const ParamBinding* Lowering::binding(std::string_view name) const {
    for (const ParamBinding& bound : layer->params)
        if (bound.name == name) return &bound;
    return nullptr;
}

jit::InputInfo Lowering::element_input(std::string_view name, BaseType type,
                                       const ParamBinding& bound, int element, int component) {
    std::string text = "param:" + std::to_string(layer_index) + ":" + std::string(name);
    if (element >= 0) text += "[" + std::to_string(element) + "]";
    text += component_suffix(type, component);
    jit::Type t = type == BaseType::String ? jit::Type::I : jit::Type::F;
    if (bound.kind == ParamBinding::Kind::Frame) return {text, t, jit::Rate::Frame, "", ""};
    return {text, t, jit::Rate::Point, text + ":du", text + ":dv"};
}

// A binding's value, in the layer's current; `element` of an array type.
Lowered Lowering::bound_value(const ParamBinding& bound, std::string_view name, Type type,
                              int element) {
    Lowered value = bound_input(bound, name, type, element);
    if (bound.plain) return value;
    return bound.kind == ParamBinding::Kind::Varying ? from_object(value) : into_layer(value);
}

Lowered Lowering::bound_input(const ParamBinding& bound, std::string_view name, Type type,
                              int element) {
    Lowered result = zero(type.base);
    size_t n = size_t(result.size());
    size_t first = size_t(element) * n;
    for (size_t c = 0; c < n; ++c) {
        if (bound.kind != ParamBinding::Kind::Constant)
            result.c[c] = b.input(
                element_input(name, type.base, bound, type.is_array() ? element : -1, int(c)));
        else if (type.base == BaseType::String && size_t(element) < bound.strings.size())
            result.c[c] = b.i(intern(bound.strings[size_t(element)]));
        else if (type.base != BaseType::String && first + c < bound.constant.size())
            result.c[c] = b.f(bound.constant[first + c]);
    }
    return result;
}

Lowered Lowering::parameter(const Symbol& symbol) {
    const ParamBinding* bound = binding(symbol.name);
    if (bound && bound->kind != ParamBinding::Kind::Default)
        return bound_value(*bound, symbol.name, symbol.type, 0);
    if (!symbol.initial) return zero(symbol.type.base);
    Lowered result = expr(*symbol.initial);
    result.type = symbol.type.base;
    return result;
}

}  // namespace kinora::rsl
