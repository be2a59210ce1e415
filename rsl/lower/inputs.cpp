// rsl/lower/inputs.cpp: the kernel's inputs: globals and parameters.
#include "rsl/lower/inputs.h"

#include <utility>

#include "rsl/lower/services.h"
#include "rsl/lower/values.h"

namespace kinora::rsl {

namespace {

// A global and the input that it is.
struct GlobalInput {
    Global id;
    Global input;
    Slopes slopes = Slopes::None;
    jit::Rate rate = jit::Rate::Point;
};
// Those of surfaces.
const GlobalInput kInputs[] = {
    {Global::P, Global::P, Slopes::Given},
    {Global::dPdu, Global::dPdu},
    {Global::dPdv, Global::dPdv},
    {Global::N, Global::N, Slopes::Given},
    {Global::Ng, Global::Ng},
    {Global::I, Global::I, Slopes::Given},
    {Global::u, Global::u, Slopes::Given},
    {Global::v, Global::v, Slopes::Given},
    {Global::du, Global::du},
    {Global::dv, Global::dv},
    {Global::s, Global::s, Slopes::Given},
    {Global::t, Global::t, Slopes::Given},
    {Global::Ps, Global::P, Slopes::Given},
    {Global::Ns, Global::N, Slopes::Given},
    {Global::E, Global::E, Slopes::None, jit::Rate::Frame},
    {Global::time, Global::time, Slopes::None, jit::Rate::Frame},
    {Global::dtime, Global::dtime, Slopes::None, jit::Rate::Frame},
};
// Those of lights: the rest is 0, but see light_global().
const GlobalInput kLightInputs[] = {
    {Global::Ps, Global::Ps},
    {Global::Ns, Global::Ns},
    {Global::N, Global::Ns},
    {Global::E, Global::E, Slopes::None, jit::Rate::Frame},
    {Global::time, Global::time, Slopes::None, jit::Rate::Frame},
    {Global::dtime, Global::dtime, Slopes::None, jit::Rate::Frame},
};
// Those of lights on geometry, at the sample; u, v and what is along them are the mesh's.
const GlobalInput kAreaInputs[] = {
    {Global::P, Global::P},       {Global::N, Global::N},       {Global::Ng, Global::Ng},
    {Global::dPdu, Global::dPdu}, {Global::dPdv, Global::dPdv}, {Global::u, Global::u},
    {Global::v, Global::v},       {Global::s, Global::s},       {Global::t, Global::t},
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

Lowered Globals::read(Global id) {
    if (slots_.live(int(id))) return slots_.read(int(id));
    // Outside of illuminance the point that is lit is the one that is shaded, where it now is.
    bool shaded = context_.kind() == ShaderKind::Surface || context_.kind() == ShaderKind::Volume;
    return id == Global::Ps && shaded ? lowered(BaseType::Point, read(Global::P).v3()) : input(id);
}

// For displacements that only bend normals: P whose slopes lie in the plane that N is normal to,
// not in that of the face. What calculatenormal() makes of it is N bent, and shows no faces.
Lowered Globals::smooth_P(const Lowered& N) {
    auto fixed = [&](const V3& v) {  // without slopes of its own
        return V3{b_.op(jit::Op::WithSlope, v[0], b_.f(0)),
                  b_.op(jit::Op::WithSlope, v[1], b_.f(0)),
                  b_.op(jit::Op::WithSlope, v[2], b_.f(0))};
    };
    V3 P = input(Global::P).v3();
    V3 n = fixed(e_.normalize(N.v3()));
    V3 way{b_.f(0), b_.f(0), b_.f(0)};  // its slopes are those of P
    for (auto [edge, along] :
         {std::pair(Global::dPdu, Global::u), std::pair(Global::dPdv, Global::v)}) {
        V3 d = input(edge).v3();
        d = fixed(e_.sub(d, e_.scale(n, e_.dot(n, d))));
        way = e_.fma(d, input(along).c[0], way);
    }
    for (size_t c = 0; c < 3; ++c) P[c] = b_.op(jit::Op::WithSlope, P[c], way[c]);
    return lowered(BaseType::Point, P);
}

V3 Globals::normal_of(const V3& p) {
    V3 normal = e_.cross(e_.du(p), e_.dv(p));
    V3 own = e_.cross(input(Global::dPdu).v3(), input(Global::dPdv).v3());
    Value against = b_.lt(e_.dot(own, input(Global::Ng).v3()), e_.f(0));
    V3 value = e_.select(against, e_.neg(normal), normal), N = input(Global::N).v3();
    for (size_t k = 0; k < 3; ++k) value[k] = b_.op(jit::Op::WithSlope, value[k], N[k]);
    return value;
}

// What a light sees of itself: it stands at the origin of its space.
Lowered Globals::light_global(const GlobalInfo& info) {
    if (info.id == Global::P) {
        V3 origin;
        for (int r = 0; r < 3; ++r)
            origin[size_t(r)] =
                scalar_input(b_, space_key("shader", true, r, 3), jit::Type::F, jit::Rate::Frame);
        return lowered(BaseType::Point, origin);
    }
    if (info.id == Global::I) {
        V3 ps = read(Global::Ps).v3();
        return lowered(BaseType::Vector, e_.sub(ps, read(Global::E).v3()));
    }
    return zero(e_, info.type.base);
}

// Normals of length 1 stay so in the object's space: true displacement hands those.
Lowered Globals::input(Global id) {
    Lowered x = kernel_input(id);
    if (!context_.bends_normals() || !is_spatial(x.type)) return x;
    x = spaces_.into_layer(x);
    return x.type == BaseType::Normal ? lowered(x.type, e_.normalize(x.v3())) : x;
}

Lowered Globals::kernel_input(Global id) {
    const GlobalInfo& info = global_info(id);
    BaseType type = info.type.base;
    bool light = context_.kind() == ShaderKind::Light;
    if (!((info.readers | info.writers) & in_kind(context_.kind())))
        return zero(e_, type);                                      // warned of
    if (const ParamBinding* bound = context_.binding(info.name)) {  // a bound Cs or Os
        if (bound->kind != ParamBinding::Kind::Default)
            return parameters_.bound_value(*bound, info.name, {type, -1}, 0);
    }
    bool behind = context_.kind() == ShaderKind::Volume || context_.kind() == ShaderKind::Imager;
    if (behind && (id == Global::Ci || id == Global::Oi))
        return global_input(b_, id, jit::Rate::Point);
    if (context_.kind() == ShaderKind::Imager && id == Global::alpha)
        return global_input(b_, id, jit::Rate::Point);
    if (light && context_.options.area_light)
        for (const GlobalInput& row : kAreaInputs)
            if (row.id == id) return global_input(b_, row.input, row.rate, row.slopes);
    auto rows =
        light ? std::span<const GlobalInput>(kLightInputs) : std::span<const GlobalInput>(kInputs);
    for (const GlobalInput& row : rows)
        if (row.id == id) return global_input(b_, row.input, row.rate, row.slopes);
    for (const GlobalConstant& row : kConstants)
        if (row.id == id) return convert(e_, lowered(BaseType::Float, b_.f(row.value)), type);
    return light ? light_global(info) : zero(e_, type);
}

// ---- parameters ---------------------------------------------------------------------------------

jit::InputInfo BoundParameters::element_input(std::string_view name, BaseType type,
                                              const ParamBinding& bound, int element,
                                              int component) {
    KernelKey key =
        parameter_key(uint32_t(context_.layer_index), name, element, form_of(type), component);
    jit::Type number = type == BaseType::String ? jit::Type::I : jit::Type::F;
    bool frame = bound.kind == ParamBinding::Kind::Frame;
    return input_info(key, number, frame ? jit::Rate::Frame : jit::Rate::Point,
                      frame ? Slopes::None : Slopes::Given);
}

// A binding's value, in the layer's current; `element` of an array type.
Lowered BoundParameters::bound_value(const ParamBinding& bound, std::string_view name, Type type,
                                     int element) {
    if (bound.kind == ParamBinding::Kind::Layer) return left_by_layer(bound, type, element);
    Lowered value = bound_input(bound, name, type, element);
    if (bound.plain) return value;
    return bound.kind == ParamBinding::Kind::Varying ? spaces_.from_object(value)
                                                     : spaces_.into_layer(value);
}

// What a layer below left, in the layer's current; zero where there is no such.
Lowered BoundParameters::left_by_layer(const ParamBinding& bound, Type type, int element) {
    const Messages::Message* left =
        bound.below <= context_.layer_index
            ? messages_.find(context_.layer_index - bound.below, bound.variable)
            : nullptr;
    if (!left) return zero(e_, type.base);
    std::vector<Lowered> values = messages_.values(*left);
    if (size_t(element) >= values.size()) return zero(e_, type.base);
    return spaces_.into_layer(convert(e_, values[size_t(element)], type.base));
}

Lowered BoundParameters::bound_input(const ParamBinding& bound, std::string_view name, Type type,
                                     int element) {
    Lowered result = zero(e_, type.base);
    size_t n = size_t(result.size());
    size_t first = size_t(element) * n;
    for (size_t c = 0; c < n; ++c) {
        if (bound.kind != ParamBinding::Kind::Constant)
            result.c[c] = b_.input(
                element_input(name, type.base, bound, type.is_array() ? element : -1, int(c)));
        else if (type.base == BaseType::String && size_t(element) < bound.strings.size())
            result.c[c] = b_.i(intern(bound.strings[size_t(element)]));
        else if (type.base != BaseType::String && first + c < bound.constant.size())
            result.c[c] = b_.f(bound.constant[first + c]);
    }
    return result;
}

}  // namespace kinora::rsl
