// rsl/builtins/texture_files.cpp: facts about texture files, and values put into point files by s
// and t.
#include "rsl/builtins/maps_p.h"
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_texture_files {

using namespace lower_maps;

// bake(file, s, t, value): a point file of points (s, t, 0), with one channel. A negative scale
// says that they are no points in current space.
void bake(LowerCall& c) {
    auto& e = c.e;
    auto& b = c.b;
    if (!c.context.options.want_Ci) return;
    c.context.out.uses_rng = true;
    const Lowered& value = c.args[3];
    Lookup at = with_derivatives(c, c.f(1), c.f(2));
    Value across =
        b.max(b.add(b.abs(at.dsdx), b.abs(at.dsdy)), b.add(b.abs(at.dtdx), b.abs(at.dtdy)));
    Value radius = b.max(b.mul(across, e.f(0.5f)), e.f(1e-6f));
    std::vector<Value> args = {c.f(0), b.i(intern(std::string(type_name(value.type)) + " value")),
                               rng_input(c.b)};
    args.insert(args.end(), {at.s, at.t, e.f(0), e.f(0), e.f(0), e.f(0), radius, e.f(-1)});
    args.insert(args.end(), value.c.begin(), value.c.begin() + value.size());
    args.resize(11 + size_t(kPointFloats), e.f(0));
    c.services.call(Service::bake3d, args);
}

// A resizable array takes as many elements as the fact has.
void fact_to_list(LowerCall& c, int array, const std::vector<Value>& answer) {
    auto& b = c.b;
    auto& arrays = c.variables.arrays();
    BaseType type = arrays.element(array);
    const bool text = type == BaseType::String;
    const size_t each = size_t(component_count(type));
    Value known = text ? b.op(jit::Op::IEq, answer[0], b.i(-1))
                       : b.op(jit::Op::ILt, b.i(int(each) - 1), answer[0]);
    Value count = text ? b.f(1) : b.floor(b.div(b.itof(answer[0]), b.f(float(each))));
    Value before = arrays.count(array);
    Value running = std::exchange(c.e.running, b.logical_and(c.e.running, known));
    arrays.fill(array, count, c.where(), [&](Value index) {
        Lowered element{type, {}};
        for (size_t i = 0; i < each; ++i) {
            Value x = answer[1 + i];
            for (size_t k = 1; (k + 1) * each < answer.size(); ++k)
                x = b.select(b.op(jit::Op::IEq, index, b.i(int(k))), answer[1 + k * each + i], x);
            element.c[i] = text ? b.bits(x) : x;
        }
        return element;
    });
    c.e.running = running;
    arrays.set_count(array, b.select(known, arrays.count(array), before));
    c.set(c.e.flag(known));
}

// textureinfo(name, field, variable): 1, and the variable set, if the fact is known and fits.
void textureinfo(LowerCall& c) {
    auto& e = c.e;
    auto& b = c.b;
    std::vector<Value> answer = c.services.call(Service::textureinfo, std::array{c.f(0), c.f(1)});
    if (int list = c.variables.resizable_array(*c.call.args[2]); list >= 0)
        return fact_to_list(c, list, answer);
    const Expr& variable = *c.call.args[2];
    BaseType type = variable.type.base;
    size_t each = size_t(component_count(type));
    bool array = variable.type.is_array();
    std::vector<Lowered> values =
        array ? c.variables.array_values(variable) : std::vector<Lowered>{c.args[2]};
    Value known = type == BaseType::String ? b.op(jit::Op::IEq, answer[0], b.i(-1))
                                           : b.op(jit::Op::ILt, b.i(int(each) - 1), answer[0]);
    for (size_t k = 0; k < values.size() && (k + 1) * each < answer.size(); ++k) {
        Value here = b.op(jit::Op::ILt, b.i(int((k + 1) * each) - 1), answer[0]);
        if (type == BaseType::String) here = k == 0 ? known : b.m(false);
        for (size_t i = 0; i < each; ++i) {
            Value x = answer[1 + k * each + i];
            if (type == BaseType::String) x = b.bits(x);
            values[k].c[i] = b.select(here, x, values[k].c[i]);
        }
    }
    if (array)
        c.variables.set_array(variable, values);
    else
        c.set_output(2, values[0]);
    c.set(e.flag(known));
}

}  // namespace lower_texture_files

namespace ref {
namespace {

// The variable is set if the fact is known and fits: so many numbers, or one text (-1).
template <class Real>
void textureinfo(RefCall<Real>& c) {
    const Type type = c.call.args[2]->type;
    size_t each = size_t(component_count(type.base));
    std::vector<double> answer =
        c.eval.service(Service::textureinfo, {double(c.f(0).x), double(c.f(1).x)});
    bool text = type.base == BaseType::String;
    double count = answer.empty() ? 0 : answer[0];
    bool known = text ? count == -1 : count >= double(each);
    c.set(Dual<Real>(Real(known)));
    size_t numbers = text ? size_t(known) : count > 0 ? size_t(count) / each * each : 0;
    if (known && c.resizable_room(2) > 0)
        c.arrays[2].assign(numbers / each, RefValue<Real>(c.args[2].type));
    for (size_t k = 0; k < numbers && k + 1 < answer.size(); ++k) {
        if (type.is_array() && k / each >= c.arrays[2].size()) break;
        RefValue<Real>& item = type.is_array() ? c.arrays[2][k / each] : c.args[2];
        item.c[k % each] = Real(answer[1 + k]);
    }
}

template <class Real>
void bake(RefCall<Real>&) {}  // what is written is no value of the point

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_texture_files;

constexpr const char* kAnyVariable =
    "f=ssF f=ssC f=ssP f=ssV f=ssN f=ssM f=ssS f=ssF[] f=ssC[] f=ssP[] f=ssV[] f=ssN[] f=ssM[] "
    "f=ssS[]";

const Builtin kRows[] = {
    {"textureinfo", kAnyVariable, lower::textureinfo, KINORA_RSL_REF(ref::textureinfo),
     kService | kNamesFile, 0,
     "A fact about a texture, 1 if known: resolution channels type exists viewingmatrix "
     "projectionmatrix."},
    {"bake", "x=sfff x=sffc x=sffp x=sffv x=sffn", lower::bake, KINORA_RSL_REF(ref::bake),
     kService | kNamesFile | kPrints | kDerivative, 0,
     "Puts a value at s, t into a point file, as channel \"value\" of the world's (s, t, 0).",
     kSurface | kDisplacement},
};

}  // namespace

std::span<const Builtin> builtins_texture_files() {
    return kRows;
}

}  // namespace kinora::rsl
