// rsl/builtins/arrays.cpp: resizable arrays.
#include <algorithm>
#include <array>

#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/lower/values.h"
#include "rsl/model/changes.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_arrays {

const Symbol& symbol_of(const LowerCall& c) {
    return *as<VariableExpr>(*c.call.args[0]).symbol;
}

int array_of(LowerCall& c) {
    return c.variables.array_of(symbol_of(c));
}

// The array that changes its length; -1 where a function's argument cannot.
int resizable(LowerCall& c) {
    int array = array_of(c);
    if (c.variables.arrays().resizable(array)) return array;
    c.context.error(Code::RSL_NOT_RESIZABLE, c.where(), symbol_of(c).name);
    return -1;
}

void arraylength(LowerCall& c) {
    c.set(c.variables.arrays().count(array_of(c)));
}

void capacity(LowerCall& c) {
    c.set(c.b.f(float(c.variables.room_for(symbol_of(c)))));
}

void resize(LowerCall& c) {
    int array = resizable(c);
    if (array >= 0) c.variables.arrays().resize(array, c.f(1), c.where());
}

void reserve(LowerCall& c) {
    int array = resizable(c);
    if (array >= 0) c.variables.arrays().limited(array, c.f(1), c.where());
}

void push(LowerCall& c) {
    int array = resizable(c);
    if (array >= 0) c.variables.arrays().push(array, c.args[1], c.where());
}

void pop(LowerCall& c) {
    int array = resizable(c);
    if (array < 0) return;
    c.result = c.variables.arrays().pop(array, c.where());
}

// Whether none of so many elements differs: a loop that ends at the first that does.
template <class Differ>
Value all_equal(LowerCall& c, Value same, Value count, Differ&& differ) {
    auto& b = c.b;
    Value some = b.logical_and(same, b.lt(b.f(0), count));
    b.begin_loop(b.logical_and(c.e.running, some),
                 b.fault_site(c.where(), "too many elements of an array"));
    Value k = b.loop_var(b.i(0)), left = b.loop_var(b.f(1));
    Value next = b.iadd(k, b.i(1)), equal = b.select(differ(k), b.f(0), b.f(1));
    b.end_loop(b.logical_and(b.lt(b.f(0), equal), b.lt(b.itof(next), count)),
               std::array{next, equal});
    Value last = b.loop_out(left);
    return b.logical_and(same, b.logical_or(b.logical_not(some), b.lt(b.f(0), last)));
}

// a == b: as many elements, each equal to the other's.
void arrayequal(LowerCall& c) {
    auto& b = c.b;
    auto& arrays = c.variables.arrays();
    int one = c.variables.array_of(*as<VariableExpr>(*c.call.args[0]).symbol);
    int other = c.variables.array_of(*as<VariableExpr>(*c.call.args[1]).symbol);
    Value count = arrays.count(one);
    Value same = b.eq(count, arrays.count(other));
    int most = std::min(arrays.length(one), arrays.length(other));
    auto differ = [&](Value k) {
        return b.logical_not(
            binary(c.e, Op::Equal, arrays.load(one, k), arrays.load(other, k)).c[0]);
    };
    constexpr int kUnrolled = 64;
    if (most > kUnrolled) return c.set(c.e.flag(all_equal(c, same, count, differ)));
    for (int k = 0; k < most; ++k) {
        Value differs = b.logical_and(b.lt(b.f(float(k)), count), differ(b.i(k)));
        same = b.logical_and(same, b.logical_not(differs));
    }
    c.set(c.e.flag(same));
}

// Element j of the n that element i of an array of structs holds, in the array of all; -1: none.
void elementof(LowerCall& c) {
    auto& b = c.b;
    Value i = b.floor(c.f(0)), n = c.f(1), j = b.floor(c.f(2));
    Value inside = b.logical_and(b.le(b.f(0), j), b.lt(j, n));
    c.set(b.select(inside, b.add(b.mul(i, n), j), b.f(-1)));
}

}  // namespace lower_arrays

namespace ref {
namespace {

template <class Real>
int room(RefCall<Real>& c) {
    const Symbol& symbol = *as<VariableExpr>(*c.call.args[0]).symbol;
    if (symbol.type.array_length > 0) return symbol.type.array_length;
    return array_capacities(*c.eval.layer->shader->ast)[symbol.id];
}

template <class Real>
void arraylength(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(c.arrays[0].size())));
}

template <class Real>
void capacity(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(room(c))));
}

template <class Real>
void resize(RefCall<Real>& c) {
    Real wanted = std::floor(c.f(1).x), most = Real(room(c));
    if (!(wanted >= 0 && wanted <= most)) ++c.eval.result.faults;
    int length = c.eval.decide(int(wanted > 0 ? std::min(wanted, most) : Real(0)));
    c.arrays[0].resize(size_t(length), RefValue<Real>(c.args[0].type));
}

template <class Real>
void reserve(RefCall<Real>& c) {
    if (!(c.f(1).x <= Real(room(c)))) ++c.eval.result.faults;
}

template <class Real>
void push(RefCall<Real>& c) {
    if (int(c.arrays[0].size()) >= room(c)) return void(++c.eval.result.faults);
    c.arrays[0].push_back(c.args[1]);
    c.arrays[0].back().type = c.args[0].type;
}

template <class Real>
void pop(RefCall<Real>& c) {
    if (c.arrays[0].empty()) return void(++c.eval.result.faults);
    c.result.c = c.arrays[0].back().c;
    c.arrays[0].pop_back();
}

template <class Real>
void arrayequal(RefCall<Real>& c) {
    bool same = c.arrays[0].size() == c.arrays[1].size();
    for (size_t k = 0; same && k < c.arrays[0].size(); ++k)
        for (size_t i = 0; i < c.arrays[0][k].size(); ++i)
            same = same && c.arrays[0][k].c[i].x == c.arrays[1][k].c[i].x;
    c.set(Dual<Real>(Real(c.eval.decide(same))));
}

template <class Real>
void elementof(RefCall<Real>& c) {
    Real i = std::floor(c.f(0).x), n = c.f(1).x, j = std::floor(c.f(2).x);
    c.set(Dual<Real>(0 <= j && j < n ? Real(i * n + j) : Real(-1)));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_arrays;

constexpr const char* kLengthOf = "f=f[] f=c[] f=p[] f=v[] f=n[] f=m[] f=s[]";
constexpr const char* kByNumber = "x=F[]f x=C[]f x=P[]f x=V[]f x=N[]f x=M[]f x=S[]f";

const Builtin kRows[] = {
    {"arraylength", kLengthOf, lower::arraylength, KINORA_RSL_REF(ref::arraylength), kReadsLength,
     0, "How many elements the array has."},
    {"capacity", kLengthOf, lower::capacity, KINORA_RSL_REF(ref::capacity), kReadsLength, 0,
     "How many elements the array has room for."},
    {"resize", kByNumber, lower::resize, KINORA_RSL_REF(ref::resize), kSetsLength, 0,
     "Gives a resizable array a length. New elements are 0 or \"\"."},
    {"reserve", kByNumber, lower::reserve, KINORA_RSL_REF(ref::reserve), kSetsLength, 0,
     "Makes room for so many elements, where that is a constant; the length stays."},
    {"push", "x=F[]f x=C[]c x=P[]p x=V[]v x=N[]n x=M[]m x=S[]s", lower::push,
     KINORA_RSL_REF(ref::push), kSetsLength, 0, "Appends an element to a resizable array."},
    {"pop", "f=F[] c=C[] p=P[] v=V[] n=N[] m=M[] s=S[]", lower::pop, KINORA_RSL_REF(ref::pop),
     kSetsLength, 0, "Takes the last element off a resizable array and returns it."},
    {"elementof", "f=fff", lower::elementof, KINORA_RSL_REF(ref::elementof), kForHeaders, 0,
     "Where a[i]->list[j] stands in the array of all lists."},
    {"arrayequal", "f=f[]f[] f=c[]c[] f=p[]p[] f=v[]v[] f=n[]n[] f=m[]m[] f=s[]s[]",
     lower::arrayequal, KINORA_RSL_REF(ref::arrayequal), kVaryingResult | kForHeaders, 0,
     "What a == b of arrays becomes."},
};

}  // namespace

std::span<const Builtin> builtins_arrays() {
    return kRows;
}

}  // namespace kinora::rsl
