// rsl/builtins/message.cpp: messages between shaders and questions to the renderer.
#include <fmt/format.h>

#include <algorithm>

#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"
#include "rsl/reference/service_calls_p.h"

namespace kinora::rsl {

namespace lower_message {

// The variable that the answer goes to, as elements: one unless it is an array.
struct Variable {
    LowerCall& c;
    const Expr& expr;
    Type type;
    std::vector<Lowered> before;

    explicit Variable(LowerCall& call) : c(call), expr(*call.call.args[1]), type(expr.type) {
        before = type.is_array() ? c.variables.array_values(expr) : std::vector<Lowered>{c.args[1]};
    }
    // The array, if its length is that of the answer; else -1.
    static int resizable(LowerCall& c) { return c.variables.resizable_array(*c.call.args[1]); }
    void store(std::span<const Lowered> values) {
        if (type.is_array())
            c.variables.set_array(expr, values);
        else
            c.set_output(1, values[0]);
    }
};

// A triple fits any triple; all else must be the same.
bool same_kind(Type asked, Type given) {
    bool bases = asked.base == given.base || (is_triple(asked.base) && is_triple(given.base));
    int asked_length = std::max(asked.array_length, -1);
    return bases && asked_length == given.array_length;
}

char type_letter(BaseType type) {
    return "fcpvnms"[int(type)];
}

// An answer of the renderer: whether it is known, and its numbers.
struct Answer {
    Value known;
    Lowered value;
};
Answer answer_of(LowerCall& c, BaseType type, std::span<const Value> row) {
    auto& b = c.b;
    Answer answer{b.logical_not(b.op(jit::Op::IEq, row[0], b.i(0))), {type, {}}};
    for (size_t i = 0; i < size_t(answer.value.size()); ++i)
        answer.value.c[i] = type == BaseType::String ? b.bits(row[1 + i]) : row[1 + i];
    return answer;
}

// A resizable array takes as many elements as the answer has.
void ask_list(LowerCall& c, QueryKind kind, int array, Value anchor) {
    auto& b = c.b;
    auto& arrays = c.variables.arrays();
    BaseType type = arrays.element(array);
    // Its length is a number whatever the elements are.
    std::vector<Value> row = c.services.call(
        Service::query, std::array{b.i(int32_t(kind)), c.args[0].c[0], b.i(type_letter(type)),
                                   b.i(kQueryLength), b.i(0), anchor});
    Value known = b.logical_not(b.op(jit::Op::IEq, row[0], b.i(0)));
    Value before = arrays.count(array), length = b.ftoi(row[1]);
    Value running = std::exchange(c.e.running, b.logical_and(c.e.running, known));
    arrays.fill(array, row[1], c.where(), [&](Value k) {
        std::vector<Value> element =
            c.services.call(Service::query, std::array{b.i(int32_t(kind)), c.args[0].c[0],
                                                       b.i(type_letter(type)), k, length, anchor});
        return answer_of(c, type, element).value;
    });
    c.e.running = running;
    arrays.set_count(array, b.select(known, arrays.count(array), before));
    c.set(c.e.flag(known));
}

// Asks the renderer; the variable keeps its value where there is no answer.
void ask(LowerCall& c, QueryKind kind, Value anchor) {
    auto& b = c.b;
    if (int list = Variable::resizable(c); list >= 0) return ask_list(c, kind, list, anchor);
    Variable variable(c);
    bool array = variable.type.is_array();
    int length = int(variable.before.size());
    std::vector<Lowered> values = variable.before;
    Value known = b.m(true);
    for (int k = 0; k < length; ++k) {
        std::vector<Value> row =
            c.services.call(Service::query, std::array{b.i(int32_t(kind)), c.args[0].c[0],
                                                       b.i(type_letter(variable.type.base)),
                                                       b.i(array ? k : -1), b.i(length), anchor});
        Answer answer = answer_of(c, variable.type.base, row);
        known = b.logical_and(known, answer.known);
        for (size_t i = 0; i < size_t(values[size_t(k)].size()); ++i)
            values[size_t(k)].c[i] = b.select(known, answer.value.c[i], values[size_t(k)].c[i]);
    }
    variable.store(values);
    c.set(c.e.flag(known));
}

void ask_at_point(LowerCall& c, QueryKind kind) {
    c.context.out.uses_rng = true;
    ask(c, kind, rng_input(c.b));
}

template <QueryKind kind>
void query(LowerCall& c) {
    if (kind == QueryKind::Option || kind == QueryKind::RendererInfo)
        ask(c, kind, c.b.i(0));
    else
        ask_at_point(c, kind);
}

// A resizable array takes all elements of a message.
void take_list(LowerCall& c, const Messages::Message& message, int array) {
    Type asked{c.variables.arrays().element(array), message.type.array_length};
    if (!message.type.is_array() || !same_kind(asked, message.type)) return;
    std::vector<Lowered> values = c.messages.values(message);
    auto& arrays = c.variables.arrays();
    arrays.set_count(array, arrays.limited(array, c.b.f(float(values.size())), c.where()));
    for (size_t k = 0; k < values.size(); ++k) arrays.store(array, c.b.i(int(k)), values[k]);
    c.set(c.b.f(1));
}

// What a layer below left in its parameter; else a parameter's value as the renderer bound it: of
// layers above, or of the surface that a light or volume works for.
template <ShaderKind from, QueryKind kind>
void of_layer(LowerCall& c) {
    const std::string* name = c.e.constant_text(c.args[0].c[0]);
    auto& messages = c.messages.list();
    for (auto m = messages.rbegin(); name && m != messages.rend(); ++m) {
        if (m->from != from || m->name != *name) continue;
        if (int list = Variable::resizable(c); list >= 0) return take_list(c, *m, list);
        Variable variable(c);
        if (!same_kind(variable.type, m->type)) return;
        variable.store(c.messages.values(*m));
        return c.set(c.b.f(1));
    }
    ask_at_point(c, kind);
}

// A vertex input that no parameter declares (Shader::vertex_requests).
void vertexvalue(LowerCall& c) {
    auto& b = c.b;
    const std::string* name = c.e.constant_text(c.args[0].c[0]);
    bool reads = c.args.size() > 1;
    BaseType type = reads ? c.call.args[1]->type.base : BaseType::Float;
    if (reads && c.call.args[1]->type.is_array()) return c.set(b.f(0));
    Value known = b.m(false);
    Lowered value = reads ? c.args[1] : lowered(BaseType::Float, b.f(0));
    for (const ParamBinding& bound : c.context.layer->params) {
        std::optional<std::string_view> input = requested_input(bound.name, type);
        if (!input || (name && *name != *input)) continue;
        Value meant = name ? b.m(true) : b.op(jit::Op::IEq, c.args[0].c[0], b.i(intern(*input)));
        known = b.logical_or(known, meant);
        if (!reads) continue;
        Lowered given = c.variables.vertex_input(bound, type);
        for (size_t k = 0; k < size_t(value.size()); ++k)
            value.c[k] = b.select(meant, given.c[k], value.c[k]);
    }
    if (reads) c.set_output(1, value);
    c.set(c.e.flag(known));
}

// A parameter of the light that the illuminance loop is at: from its record, or where the name or
// the length is known at run time only, as it is bound.
void lightsource(LowerCall& c) {
    if (!c.lights.any_current()) return;
    const std::string* name = c.e.constant_text(c.args[0].c[0]);
    if (!name || Variable::resizable(c) >= 0) {
        c.context.out.tells_lights_apart = true;
        auto [set, record] = c.lights.current();
        Value light = record_uniform(c.b, set, record, kLightNumber, jit::Type::I);
        return ask(c, QueryKind::Light, light);
    }
    Variable variable(c);
    Value known;
    std::vector<Lowered> values = c.lights.message(*name, variable.type, variable.before, &known);
    variable.store(values);
    c.set(c.e.flag(known));
}

// What getlights() gives for the light that the illuminance loop is at: below 0.
void lighthandle(LowerCall& c) {
    if (!c.lights.any_current()) return;
    c.context.out.tells_lights_apart = true;
    auto [set, record] = c.lights.current();
    Value handle = record_uniform(c.b, set, record, kLightHandle, jit::Type::I);
    c.set(c.b.sub(c.b.f(-1), c.b.itof(handle)));
}

// A call that nothing answers: the value is 0.
void nullcall(LowerCall& c) {
    const std::string* name = c.text(0);
    if (!name) return;
    c.b.fault(
        c.b.fault_site(c.where(), fmt::format("'{}()' is called through a shader that is null "
                                              "or has no such method: it gives 0",
                                              *name)),
        c.e.running);
    c.set(c.b.f(0));
}

// Name of this shader, or of the one of a kind that works on the same point; "" if there is none.
void shadername(LowerCall& c) {
    if (c.args.empty()) return c.set(c.b.i(intern(c.context.layer->shader->name)));
    const std::string* kind = c.text(0);
    if (!kind) return;
    for (auto layer = c.context.layers.rbegin(); layer != c.context.layers.rend(); ++layer)
        if (*kind == shader_kind_name(layer->shader->kind))
            return c.set(c.b.i(intern(layer->shader->name)));
    c.context.out.uses_rng = true;
    Value anchor = rng_input(c.b);
    std::vector<Value> answer = c.services.call(
        Service::query, std::array{c.b.i(int32_t(QueryKind::ShaderName)), c.args[0].c[0],
                                   c.b.i('s'), c.b.i(-1), c.b.i(1), anchor});
    Value known = c.b.logical_not(c.b.op(jit::Op::IEq, answer[0], c.b.i(0)));
    c.set(c.b.select(known, c.b.bits(answer[1]), c.b.i(0)));
}

// rayinfo's facts as functions of their own.
void ray_fact(LowerCall& c, const char* name) {
    auto& b = c.b;
    c.context.out.uses_rng = true;
    std::vector<Value> answer = c.services.call(
        Service::query,
        std::array{b.i(int32_t(QueryKind::RayInfo)), b.i(intern(name)),
                   b.i(type_letter(c.result_type())), b.i(-1), b.i(1), rng_input(c.b)});
    if (c.result_type() == BaseType::String) return c.set(b.bits(answer[1]));
    for (size_t k = 0; k < size_t(c.result.size()); ++k) c.result.c[k] = answer[1 + k];
}
void raydepth(LowerCall& c) {
    ray_fact(c, "depth");
}
// BMRT's question whether the ray only asks how opaque the surface is.
void isshadowray(LowerCall& c) {
    c.set(c.b.f(c.context.options.want_Ci ? 0.0f : 1.0f));
}
void isindirectray(LowerCall& c) {
    auto& b = c.b;
    c.context.out.uses_rng = true;
    std::vector<Value> answer = c.services.call(
        Service::query, std::array{b.i(int32_t(QueryKind::RayInfo)), b.i(intern("type")), b.i('s'),
                                   b.i(-1), b.i(1), rng_input(b)});
    c.set(c.e.flag(b.op(jit::Op::IEq, b.bits(answer[1]), b.i(intern("diffuse")))));
}
// What a class's displacement() does where its surface is shaded: see docs/displacement.md.
void displaced(LowerCall& c) {
    const Shader* own = c.context.layer->shader->displacement.get();
    bool done = std::any_of(c.context.layers.begin(), c.context.layers.end(),
                            [&](const Layer& layer) { return layer.done && layer.shader == own; });
    c.set(c.b.f(done ? 1.0f : c.context.options.moves_points ? 2.0f : 0.0f));
}
void seenopacity(LowerCall& c) {
    auto& b = c.b;
    float threshold = c.context.options.opacity_threshold;
    Value seen = b.m(false);
    for (Value channel : c.v3(0)) {
        Value hidden = threshold > 0 ? b.le(channel, b.f(threshold)) : b.eq(channel, b.f(0));
        seen = b.logical_or(seen, b.logical_not(hidden));
    }
    c.set(c.e.flag(seen));
}
// 1 behind the ray of a mirror or lens, 2 for indirect diffuse light, else 0.
void raykind(LowerCall& c) {
    auto& b = c.b;
    c.context.out.uses_rng = true;
    std::vector<Value> answer = c.services.call(
        Service::query, std::array{b.i(int32_t(QueryKind::RayInfo)), b.i(intern("type")), b.i('s'),
                                   b.i(-1), b.i(1), rng_input(b)});
    auto is = [&](const char* type) {
        return b.op(jit::Op::IEq, b.bits(answer[1]), b.i(intern(type)));
    };
    c.set(b.select(is("diffuse"), b.f(2), b.select(is("specular"), b.f(1), b.f(0))));
}
// A grid of one point.
void itself(LowerCall& c) {
    c.set(c.f(0));
}
void raylabel(LowerCall& c) {
    ray_fact(c, "label");
}
void rayorigin(LowerCall& c) {
    ray_fact(c, "origin");
}
void raydirection(LowerCall& c) {
    ray_fact(c, "direction");
}
void raylength(LowerCall& c) {
    ray_fact(c, "length");
}

}  // namespace lower_message

namespace ref {
namespace {

// The renderer's answer: known, then numbers.
template <class Real>
std::vector<double> answer_of(RefCall<Real>& c, QueryKind kind, int element, size_t length) {
    int letter = "fcpvnms"[int(c.call.args[1]->type.base)];
    double light = kind == QueryKind::Light && c.eval.light ? c.eval.light->which : 0;
    return c.eval.service(Service::query, {double(int(kind)), double(c.args[0].c[0].x),
                                           double(letter), double(element), double(length), light});
}

// Sets elements as long as all before are known; a resizable array gets the answer's length.
template <class Real>
void ask_list(RefCall<Real>& c, QueryKind kind) {
    std::vector<RefValue<Real>>& items = c.arrays[1];
    int room = c.resizable_room(1);
    bool resizable = room > 0;
    size_t length = items.size();
    bool known = true;
    if (resizable) {
        std::vector<double> answer = answer_of(c, kind, kQueryLength, 0);
        known = at(answer, 0) != 0;
        c.set(Dual<Real>(Real(known)));
        if (!known) return;
        Real wanted = std::floor(Real(at(answer, 1)));
        if (!(wanted >= 0 && wanted <= Real(room))) ++c.eval.result.faults;
        length = size_t(wanted > 0 ? wanted : Real(0));
        items.resize(std::min(length, size_t(room)), RefValue<Real>(c.args[1].type));
    }
    for (size_t k = 0; k < items.size(); ++k) {
        std::vector<double> answer = answer_of(c, kind, int(k), length);
        if (!resizable) known = known && at(answer, 0) != 0;
        for (size_t i = 0; known && i < items[k].size(); ++i)
            items[k].c[i] = Dual<Real>(Real(at(answer, 1 + i)));
    }
    c.set(Dual<Real>(Real(known)));
}

// Sets args[1] where the renderer knows the answer.
template <class Real>
void ask(RefCall<Real>& c, QueryKind kind) {
    if (c.call.args[1]->type.is_array()) return ask_list(c, kind);
    std::vector<double> answer = answer_of(c, kind, -1, 1);
    bool known = at(answer, 0) != 0;
    c.set(Dual<Real>(Real(known)));
    for (size_t k = 0; known && k < c.args[1].size(); ++k)
        c.args[1].c[k] = Dual<Real>(Real(at(answer, 1 + k)));
}

template <class Real>
void fact(RefCall<Real>& c, const char* name) {
    int letter = "fcpvnms"[int(c.result.type)];
    set_from(c,
             c.eval.service(Service::query, {double(int(QueryKind::RayInfo)), double(intern(name)),
                                             double(letter), -1, 1, 0}),
             1);
}

#define KINORA_ASK(name, kind)    \
    template <class Real>         \
    void name(RefCall<Real>& c) { \
        ask(c, QueryKind::kind);  \
    }
KINORA_ASK(surface_message, Surface)
KINORA_ASK(displacement_message, Displacement)
KINORA_ASK(atmosphere, Atmosphere)
KINORA_ASK(incident, Incident)
KINORA_ASK(opposite, Opposite)
KINORA_ASK(attribute, Attribute)
KINORA_ASK(option, Option)
KINORA_ASK(rendererinfo, RendererInfo)
KINORA_ASK(rayinfo, RayInfo)
#undef KINORA_ASK

#define KINORA_FACT(function, name)   \
    template <class Real>             \
    void function(RefCall<Real>& c) { \
        fact(c, name);                \
    }
KINORA_FACT(raydepth, "depth")
KINORA_FACT(raylabel, "label")
KINORA_FACT(rayorigin, "origin")
KINORA_FACT(raydirection, "direction")
KINORA_FACT(raylength, "length")
#undef KINORA_FACT

template <class Real>
void isshadowray(RefCall<Real>& c) {  // it looks as the camera does
    c.set(Dual<Real>(0));
}

template <class Real>
void isindirectray(RefCall<Real>& c) {
    std::vector<double> answer = c.eval.service(
        Service::query,
        {double(int(QueryKind::RayInfo)), double(intern("type")), double('s'), -1, 1, 0});
    c.set(Dual<Real>(Real(at(answer, 1) == double(intern("diffuse")))));
}

template <class Real>
void raykind(RefCall<Real>& c) {
    std::vector<double> answer = c.eval.service(
        Service::query,
        {double(int(QueryKind::RayInfo)), double(intern("type")), double('s'), -1, 1, 0});
    double type = at(answer, 1);
    int kind = type == double(intern("diffuse")) ? 2 : type == double(intern("specular")) ? 1 : 0;
    c.set(Dual<Real>(Real(kind)));
}
template <class Real>
void displaced(RefCall<Real>& c) {
    c.set(Dual<Real>(0));
}
template <class Real>
void seenopacity(RefCall<Real>& c) {
    bool seen = false;
    for (const auto& channel : c.v(0)) seen = seen || channel.x != 0;
    c.set(Dual<Real>(Real(seen)));
}

template <class Real>
void itself(RefCall<Real>& c) {
    c.set(c.f(0));
}

template <class Real>
void lightsource(RefCall<Real>& c) {
    const Type type = c.call.args[1]->type;
    size_t each = size_t(component_count(type.base)),
           length = std::max(c.arrays[1].size(), size_t(1));
    const bool written = c.call.args[0]->kind == ExprKind::String;
    if (c.eval.light && (!written || c.resizable_room(1) > 0)) return ask(c, QueryKind::Light);
    std::vector<double> found = c.eval.messages(c.text(0), each * length);
    c.set(Dual<Real>(Real(found.empty() ? 0 : 1)));
    for (size_t k = 0; k < found.size(); ++k) {
        RefValue<Real>& item = type.is_array() ? c.arrays[1][k / each] : c.args[1];
        item.c[k % each] = Real(found[k]);
    }
}

template <class Real>
void vertexvalue(RefCall<Real>& c) {
    bool reads = c.args.size() > 1;
    Symbol symbol;
    if (reads) symbol.type = c.call.args[1]->type;
    if (symbol.type.is_array()) return c.set(Dual<Real>(Real(0)));
    if (!reads) symbol.type = {BaseType::Float, -1};
    std::string name = vertex_request_name(symbol.type.base, c.text(0));
    symbol.name = name;
    bool known = false;
    for (const ParamBinding& bound : c.eval.layer->params) known = known || bound.name == name;
    if (known && reads) c.args[1] = c.eval.parameter(symbol, -1);
    c.set(Dual<Real>(Real(known)));
}

template <class Real>
void lighthandle(RefCall<Real>& c) {
    if (c.eval.light) c.set(Dual<Real>(Real(-1 - c.eval.light_number)));
}

template <class Real>
void nullcall(RefCall<Real>& c) {
    ++c.eval.result.faults;
    c.set(Dual<Real>(Real(0)));
}

template <class Real>
void shadername(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(intern(c.args.empty() ? c.eval.layer->shader->name : ""))));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_message;

// A name and a variable of any type, which is set where the function answers 1.
constexpr const char* kAnyVariable =
    "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] f=sM[] f=sS[]";

const Builtin kRows[] = {
    {"surface", kAnyVariable, lower::of_layer<ShaderKind::Surface, QueryKind::Surface>,
     KINORA_RSL_REF(ref::surface_message), kMessage | kVaryingResult, 0,
     "Value of a surface parameter: 1 if there is one."},
    {"displacement", kAnyVariable,
     lower::of_layer<ShaderKind::Displacement, QueryKind::Displacement>,
     KINORA_RSL_REF(ref::displacement_message), kMessage | kVaryingResult, 0,
     "Value of a displacement parameter: 1 if there is one."},
    {"lightsource", kAnyVariable, lower::lightsource, KINORA_RSL_REF(ref::lightsource),
     kMessage | kVaryingResult, 0,
     "Value of a parameter of the light in an illuminance loop: 1 if it has one."},
    {"atmosphere", kAnyVariable, lower::query<QueryKind::Atmosphere>,
     KINORA_RSL_REF(ref::atmosphere), kMessage | kVaryingResult, 0,
     "Value of a parameter of the scene's atmosphere: 1 if there is one."},
    {"incident", kAnyVariable, lower::query<QueryKind::Incident>, KINORA_RSL_REF(ref::incident),
     kMessage | kVaryingResult, 0,
     "Value of a parameter of the volume that the ray comes through: 1 if there is one."},
    {"opposite", kAnyVariable, lower::query<QueryKind::Opposite>, KINORA_RSL_REF(ref::opposite),
     kMessage | kVaryingResult, 0,
     "Value of a parameter of the volume on the surface's other side: 1 if there is one."},
    {"attribute", kAnyVariable, lower::query<QueryKind::Attribute>, KINORA_RSL_REF(ref::attribute),
     kMessage | kVaryingResult, 0, "Value of an attribute of the geometry: 1 if known."},
    {"option", kAnyVariable, lower::query<QueryKind::Option>, KINORA_RSL_REF(ref::option), kMessage,
     0, "Value of an option of the renderer: 1 if known."},
    {"rendererinfo", kAnyVariable, lower::query<QueryKind::RendererInfo>,
     KINORA_RSL_REF(ref::rendererinfo), kMessage, 0, "A fact about the renderer: 1 if known."},
    {"rayinfo", kAnyVariable, lower::query<QueryKind::RayInfo>, KINORA_RSL_REF(ref::rayinfo),
     kMessage | kVaryingResult, 0,
     "A fact about the ray that sees the point (depth type label origin direction length intent): "
     "1 if "
     "known."},
    {"raydepth", "f=", lower::raydepth, KINORA_RSL_REF(ref::raydepth), kMessage | kVaryingResult, 0,
     "How many rays lie between the eye and this point: 0 for what the camera sees."},
    {"raylevel", "f=", lower::raydepth, KINORA_RSL_REF(ref::raydepth), kMessage | kVaryingResult, 0,
     "BMRT's name of raydepth."},
    {"isshadowray", "f=", lower::isshadowray, KINORA_RSL_REF(ref::isshadowray), kMessage, 0,
     "1 where only the opacity is asked for, as by rays to lights (BMRT)."},
    {"isindirectray", "f=", lower::isindirectray, KINORA_RSL_REF(ref::isindirectray),
     kMessage | kVaryingResult, 0,
     "1 where indirect diffuse light is gathered: rayinfo's type is \"diffuse\" (BMRT)."},
    {"raylabel", "s=", lower::raylabel, KINORA_RSL_REF(ref::raylabel), kMessage | kVaryingResult, 0,
     "The label that trace or gather gave the ray that sees the point."},
    {"rayorigin", "p=", lower::rayorigin, KINORA_RSL_REF(ref::rayorigin), kMessage | kVaryingResult,
     0, "Where the ray that sees the point began."},
    {"raydirection", "v=", lower::raydirection, KINORA_RSL_REF(ref::raydirection),
     kMessage | kVaryingResult, 0, "Its direction, of length 1."},
    {"raylength", "f=", lower::raylength, KINORA_RSL_REF(ref::raylength), kMessage | kVaryingResult,
     0, "The distance it went."},
    {"gridmin", "f=f", lower::itself, KINORA_RSL_REF(ref::itself), kVaryingResult, 0,
     "The smallest value of a grid. No result depends on grids here: it is the point's own."},
    {"gridmax", "f=f", lower::itself, KINORA_RSL_REF(ref::itself), kVaryingResult, 0,
     "The largest value of a grid. No result depends on grids here: it is the point's own."},
    {"lighthandle", "f=", lower::lighthandle, KINORA_RSL_REF(ref::lighthandle),
     kMessage | kVaryingResult | kForHeaders, 0,
     "In illuminance: the light as getlights() gives it, a value of type shader."},
    {"displacementvalue", kAnyVariable,
     lower::of_layer<ShaderKind::Displacement, QueryKind::Displacement>,
     KINORA_RSL_REF(ref::displacement_message), kMessage | kVaryingResult | kForHeaders, 0,
     "displacement(): what a class's displacement left for its surface."},
    {"displaced", "f=", lower::displaced, KINORA_RSL_REF(ref::displaced), kMessage | kForHeaders, 0,
     "1 where a class's displacement() has moved the vertices, 2 where it moves P, 0 where it "
     "bends "
     "N."},
    {"seenopacity", "f=c", lower::seenopacity, KINORA_RSL_REF(ref::seenopacity), kForHeaders, 0,
     "1 where a class's opacity() leaves anything above the threshold."},
    {"raykind", "f=", lower::raykind, KINORA_RSL_REF(ref::raykind),
     kMessage | kVaryingResult | kForHeaders, 0,
     "1 behind the ray of a mirror or lens, 2 for indirect diffuse light, else 0."},
    {"vertexvalue",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] f=sM[] f=sS[] f=s",
     lower::vertexvalue, KINORA_RSL_REF(ref::vertexvalue), kMessage | kVaryingResult | kForHeaders,
     0, "What readprimvar() of a name that the shader does not have becomes."},
    {"nullcall", "f=s", lower::nullcall, KINORA_RSL_REF(ref::nullcall), kService | kForHeaders, 0,
     "What a call through a shader that is null becomes: reports the method's name and gives 0."},
    {"shadername", "s= s=s", lower::shadername, KINORA_RSL_REF(ref::shadername),
     kMessage | kVaryingResult, 0, "Name of this shader, or of the one of a kind."},
};

}  // namespace

std::span<const Builtin> builtins_message() {
    return kRows;
}

}  // namespace kinora::rsl
