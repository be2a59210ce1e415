// rsl/builtins_message.cpp: rows of the built-in table: messages between shaders and questions to
// the renderer.
#include "rsl/builtin.h"
#include "rsl/lower_p.h"
#include "rsl/reference_builtins.h"

namespace kinora::rsl {

namespace lower_message {

bool is_array(const LowerCall& c) {
    return c.call.args[1]->type.is_array();
}

// What a layer of the kind left in its parameter: the layers below this one are done.
template <ShaderKind from>
void of_layer(LowerCall& c) {
    const std::string* name = c.text(0);
    if (!name || is_array(c)) return;
    auto& messages = c.low.messages;
    for (auto m = messages.rbegin(); m != messages.rend(); ++m) {
        if (m->from != from || m->name != *name) continue;
        if (m->value.size() != c.args[1].size()) return;
        c.set_output(1, m->value);
        return c.set(c.b.f(1));
    }
}

// A parameter of the light that the illuminance loop is at. __nondiffuse and __nonspecular are
// uniforms of every record.
void lightsource(LowerCall& c) {
    const std::string* name = c.text(0);
    auto& e = c.low;
    if (!name || is_array(c) || e.current_record == jit::kNone) return;
    Value set = e.current_set, record = e.current_record;
    const Lowered& before = c.args[1];
    if (before.type == BaseType::Float && (*name == "__nondiffuse" || *name == "__nonspecular")) {
        int field = *name == "__nondiffuse" ? kLightNondiffuse : kLightNonspecular;
        c.set_output(1,
                     lowered(BaseType::Float, e.record_uniform(set, record, field, jit::Type::F)));
        return c.set(c.b.f(1));
    }
    int message;
    int column = e.message_column(*name, before.type, &message);
    Value has = e.record_uniform(set, record, kLightUniforms + message, jit::Type::I);
    Value known = c.b.logical_not(c.b.op(jit::Op::IEq, has, c.b.i(0)));
    jit::Type type = before.type == BaseType::String ? jit::Type::I : jit::Type::F;
    Lowered value = before;
    for (int k = 0; k < value.size(); ++k)
        value.c[size_t(k)] =
            c.b.select(known, e.record_field(set, record, column + k, type), before.c[size_t(k)]);
    c.set_output(1, value);
    c.set(e.flag(known));
}

// Not known to this renderer: 0, and the variable keeps its value.
void unknown(LowerCall&) {}

// Name of this shader; a kind other than its own names none.
void shadername(LowerCall& c) {
    const Shader& shader = *c.low.layer->shader;
    if (c.args.size() == 1) {
        const std::string* kind = c.text(0);
        if (!kind || *kind != shader_kind_name(shader.kind)) return;
    }
    c.set(c.b.i(intern(shader.name)));
}

}  // namespace lower_message

namespace {

namespace lower = lower_message;

const Builtin kRows[] = {
    {"surface",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::of_layer<ShaderKind::Surface>,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a surface parameter: 1 if there is one."},
    {"displacement",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::of_layer<ShaderKind::Displacement>,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a displacement parameter: 1 if there is one."},
    {"lightsource",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::lightsource, KINORA_RSL_REF(ref::lightsource), kMessage | kVaryingResult, 0,
     "Value of a parameter of the light in an illuminance loop."},
    {"atmosphere",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::unknown,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a volume parameter: 1 if there is one."},
    {"incident",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::unknown,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a parameter of the volume in front."},
    {"opposite",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::unknown,
     {},
     kMessage | kVaryingResult,
     0,
     "Value of a parameter of the volume behind."},
    {"attribute",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::unknown,
     {},
     kMessage,
     0,
     "Value of an attribute of the geometry: 1 if known."},
    {"option",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::unknown,
     {},
     kMessage,
     0,
     "Value of an option of the renderer: 1 if known."},
    {"rendererinfo",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::unknown,
     {},
     kMessage,
     0,
     "A fact about the renderer: 1 if known."},
    {"rayinfo",
     "f=sF f=sC f=sP f=sV f=sN f=sM f=sS f=sF[] f=sC[] f=sP[] f=sV[] f=sN[] "
     "f=sM[] f=sS[]",
     lower::unknown,
     {},
     kMessage | kVaryingResult,
     0,
     "A fact about the ray that sees the point: 1 if known."},
    {"shadername", "s= s=s", lower::shadername, KINORA_RSL_REF(ref::shadername), kMessage, 0,
     "Name of this shader, or of the one of a kind."},
};

}  // namespace

std::span<const Builtin> builtins_message() {
    return kRows;
}

}  // namespace kinora::rsl
