// rsl/reference/reference_p.h: the state of the reference evaluator, shared by its files and the
// meanings of built-ins.
#pragma once

#include <bit>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "rsl/model/builtin.h"
#include "rsl/model/kernel_keys.h"
#include "rsl/reference/dual_p.h"
#include "rsl/reference/reference.h"

namespace kinora::rsl {

// One RSL value. Strings are intern ids, Bools 0 or 1, both in c[0]; matrices are row-major for row
// vectors, as in the source.
template <class Real>
struct RefValue {
    using Number = Dual<Real>;
    BaseType type = BaseType::Void;
    std::array<Number, 16> c{};

    RefValue() = default;
    explicit RefValue(BaseType t) : type(t) {}
    RefValue(BaseType t, Number x) : type(t) { c[0] = x; }
    RefValue(BaseType t, Number x, Number y, Number z) : type(t) { c[0] = x, c[1] = y, c[2] = z; }
    size_t size() const { return size_t(component_count(type)); }
    bool truth() const { return c[0].x != 0; }
    const std::string& text() const { return interned(int32_t(c[0].x)); }
};

// Triples as vectors.
template <class Real>
using Vec = std::array<Dual<Real>, 3>;
template <class Real>
Vec<Real> vec(const RefValue<Real>& a) {
    return {a.c[0], a.c[1], a.c[2]};
}
template <class Real>
Vec<Real> operator+(const Vec<Real>& a, const Vec<Real>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Real>
Vec<Real> operator-(const Vec<Real>& a, const Vec<Real>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Real>
Vec<Real> operator*(const Dual<Real>& k, const Vec<Real>& a) {
    return {k * a[0], k * a[1], k * a[2]};
}
template <class Real>
Dual<Real> dot(const Vec<Real>& a, const Vec<Real>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Real>
Vec<Real> along_u(const Vec<Real>& a) {
    return {Dual<Real>(a[0].u), Dual<Real>(a[1].u), Dual<Real>(a[2].u)};
}
template <class Real>
Vec<Real> along_v(const Vec<Real>& a) {
    return {Dual<Real>(a[0].v), Dual<Real>(a[1].v), Dual<Real>(a[2].v)};
}
template <class Real>
Vec<Real> cross(const Vec<Real>& a, const Vec<Real>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// Rows 59, 60: free of overflow and underflow; 0 stays 0.
template <class Real>
Dual<Real> length(const Vec<Real>& a) {
    Real largest = std::max({std::fabs(a[0].x), std::fabs(a[1].x), std::fabs(a[2].x)});
    if (!(largest > 0) || std::isinf(largest)) return {largest};
    int exponent = std::ilogb(largest);
    Real scale = std::ldexp(Real(1), -exponent);
    Vec<Real> b = Dual<Real>(scale) * a;
    return Dual<Real>(std::ldexp(Real(1), exponent)) * sqrt(dot(b, b));
}
template <class Real>
Vec<Real> normalize(const Vec<Real>& a) {
    Real largest = std::max({std::fabs(a[0].x), std::fabs(a[1].x), std::fabs(a[2].x)});
    if (!(largest > 0)) return {};
    Vec<Real> b = Dual<Real>(std::ldexp(Real(1), -std::ilogb(largest))) * a;
    Dual<Real> one(1);
    return (one / length(b)) * b;
}

template <class Real>
class Reference;

// A call to a built-in: arguments in, `result` and the output arguments (in `args`) out.
template <class Real>
struct RefCall {
    using Number = Dual<Real>;
    Reference<Real>& eval;
    const CallExpr& call;
    std::vector<RefValue<Real>> args;                 // pairs are not among them
    std::vector<std::vector<RefValue<Real>>> arrays;  // of array arguments, by argument
    std::vector<std::pair<std::string, RefValue<Real>>> pairs;
    RefValue<Real> result;

    Number f(size_t i) const { return args[i].c[0]; }
    Vec<Real> v(size_t i) const { return vec(args[i]); }
    const std::string& text(size_t i) const { return args[i].text(); }
    // Elements that a resizable array among the arguments has room for; else 0.
    int resizable_room(size_t i) const;
    void set(Number x) { result.c[0] = x; }
    void set(const Vec<Real>& x) { result.c[0] = x[0], result.c[1] = x[1], result.c[2] = x[2]; }
    void set_output(size_t i, const Vec<Real>& x) { args[i] = {args[i].type, x[0], x[1], x[2]}; }
    Number pair(std::string_view name, Real otherwise) const {
        for (auto& [key, value] : pairs)
            if (key == name) return value.c[0];
        return otherwise;
    }
};

// How a statement ended: by itself, or on its way to a loop or out of the function.
struct RefFlow {
    enum Kind { Next, Break, Continue, Return } kind = Next;
    const Stmt* loop = nullptr;
};

template <class Real>
class Reference {
  public:
    using Number = Dual<Real>;
    using Item = RefValue<Real>;
    using Matrix = std::array<Number, 16>;

    Reference(std::span<const Layer> layers, const ReferenceInputs& inputs)
        : in(inputs), layers_(layers) {}
    ReferenceResult run();

    const ReferenceInputs& in;
    ReferenceResult result;
    const Layer* layer = nullptr;
    size_t layer_index = 0;
    const ReferenceLight* light = nullptr;  // inside illuminance
    int light_number = 0;                   // of it among those at the position
    bool in_solar = false;                  // inside a light's solar
    std::vector<int32_t> loop_counters;
    struct {
        uint32_t path = 0;
        bool stratifies = false;  // inside a sample method
    } inlined;
    // The second number of a sample whose first was drawn: where, and in which turns of loops.
    struct {
        bool open = false;
        uint32_t path = 0;
        std::vector<int32_t> turns;
        double number = 0;
    } drawn;

    Item& global(Global id);
    // Notes a decision that rounding may turn, and gives it back.
    template <class T>
    T decide(T value) {
        uint64_t bits = 0;  // of any NaN; -0 is 0
        if constexpr (!std::is_floating_point_v<T>)
            bits = uint64_t(int64_t(value));
        else if (value == value)
            bits = std::bit_cast<uint64_t>(double(value) + 0.0);
        result.decisions = (result.decisions ^ bits) * 0x9e3779b97f4a7c15u;
        result.decisions ^= result.decisions >> 29;
        return value;
    }
    // A value inside a built-in that rounding moves even where exact arithmetic gives a whole
    // number.
    Number rounded(Number x) {
        if (in.jitter != 0) x.x *= 1 + next_move(), x.u *= 1 + next_move(), x.v *= 1 + next_move();
        return x;
    }
    Vec<Real> rounded(const Vec<Real>& a) { return {rounded(a[0]), rounded(a[1]), rounded(a[2])}; }
    // a ^ b; what cancels in exact arithmetic need not when it is rounded.
    Vec<Real> cross(const Vec<Real>& a, const Vec<Real>& b) {
        Vec<Real> moved = rounded(b);
        return {a[1] * moved[2] - a[2] * b[1], a[2] * moved[0] - a[0] * b[2],
                a[0] * moved[1] - a[1] * b[0]};
    }
    // Beyond what a built-in promises float and double are no judges: the point is undecided.
    void no_promise() { decide(int(sizeof(Real))); }
    // inputs.cpp
    // Of the input whose component 0 is `first`; with slopes, those that the kernel's inputs have.
    Item input(const KernelKey& first, BaseType type, Slopes slopes = Slopes::None) const;
    Real number(const KernelKey& key, Real otherwise) const;
    Item first_value(Global id);   // in the layer's "current"
    Item kernel_value(Global id);  // in the kernel's
    Vec<Real> normal_of(const Vec<Real>& p);
    Item parameter(const Symbol& symbol, int element);
    Item left_by_layer(const ParamBinding& bound, BaseType type, size_t element);
    std::vector<Item> array_parameter(const Symbol& symbol);
    std::vector<double> service(Service service, std::vector<double> args);

    // spaces.cpp; matrices on row vectors
    Matrix space(const std::string& name, const char* direction) const;
    // A displacement's "current" is the object's space, that of the surfaces it is joined with the
    // camera's.
    bool bends_normals() const;
    Item into_layer(const Item& x);
    Item out_of_layer(const Item& x);
    Item from_object(const Item& x);
    Matrix input_space(const std::string& name, const char* direction) const;
    Item to_space(const Item& x, const std::string& from, const std::string& to);
    Item by_matrix(const Item& x, const Matrix& m);
    Matrix inverse(const Matrix& m);
    // color.cpp
    Vec<Real> color_space(const Vec<Real>& color, const std::string& from, const std::string& to);

    // light.cpp: f(light) for those that reach the cone around the point.
    template <class F>
    void for_each_light(const Vec<Real>* axis, const Number& angle, F&& f);
    bool in_cone(const Vec<Real>& L, const Vec<Real>* axis, const Number& angle);
    std::vector<double> messages(std::string_view name, size_t count) const;  // empty: none

    // reference.cpp
    Item expr(const Expr& e) {
        if constexpr (kObserved)
            return observed(e);
        else
            return evaluate(e);
    }
    Item convert(const Item& x, BaseType to) const;

  private:
    using Storage = std::vector<Item>;

    Item evaluate(const Expr& e);
    // observe.cpp: of the run in float alone, and nothing of it without an observer.
    static constexpr bool kObserved = std::is_same_v<Real, float>;
    Item observed(const Expr& e);
    void note_nan(const Expr& e, const Item& value) {
        if constexpr (kObserved) note_first_nan(e, value);
    }
    void note_first_nan(const Expr& e, const Item& value);
    void note(const Symbol& symbol) {
        if constexpr (kObserved) note_change(symbol);
    }
    void note_change(const Symbol& symbol);
    void tell(const Location& where) {
        if constexpr (kObserved) tell_changes(where);
    }
    void tell_changes(const Location& where);
    void tell_step(const Location& where, std::vector<ReferenceVariable> changes);
    void tell_inputs();
    void tell_light(const Location& where);
    ReferenceVariable variable(const Symbol& symbol);
    ReferenceVariable variable(Global id, const Item& value) const;

    const Symbol& means(const Symbol& symbol) const;
    Storage& storage(const Symbol& named);
    // Where a value is kept, its indices known.
    struct LValue {
        const Symbol* symbol = nullptr;
        size_t at = 0;       // which element
        int component = -1;  // of a triple; -1: all of it
    };
    LValue lvalue(const Expr& target);
    Item& item(const LValue& from);
    Item load(const LValue& from);
    size_t index(const Expr& e, size_t length);
    Item operated(const BinaryExpr& e, const Item& left);
    Item binary(Op op, const Item& a, const Item& b);
    Item operate(Op op, const Item& a, const Item& b);
    Real next_move() {  // at random in +-2^-22
        uint64_t h = (in.jitter + ++jitter_) * 0x9e3779b97f4a7c15u;
        h = (h ^ h >> 32) * 0xff51afd7ed558ccdu;
        return Real(double(int64_t(h ^ h >> 33)) * 0x1p-85);
    }
    Item jittered(Item x);
    void move_results(RefCall<Real>& call, size_t plain);
    bool compare(Op op, const Item& a, const Item& b);
    Item cast(const CastExpr& e);
    Item assign(const AssignExpr& e);
    const Symbol* lent(const CallExpr& e, size_t k) const;
    Item call_function(const CallExpr& e);
    bool may_call(const Function& f);
    void run_again(const Function& f);
    Item call_builtin(const CallExpr& e);
    void set_array(const Expr& variable, const Storage& items);
    void declare(const Symbol& symbol);
    void store(const LValue& to, const Item& value);
    void store(const Expr& target, const Item& value) { store(lvalue(target), value); }

    RefFlow statement(const Stmt& stmt);
    RefFlow block(std::span<Stmt* const> body);
    RefFlow loop(const Stmt& stmt, const Expr* condition, const Stmt& body,
                 std::span<Expr* const> step);
    RefFlow illuminance(const IlluminanceStmt& stmt);
    RefFlow gather(const GatherStmt& stmt);
    RefFlow illuminate(const Stmt& stmt, const Expr* position, const Expr* axis, const Expr* angle,
                       const Stmt& body);
    // Has the flow reached this loop? Then whether to go on with the next turn.
    bool ends_loop(RefFlow& flow, const Stmt& stmt, bool& leave);

    void smooth_P();
    void bring_back_N();
    Item given_N_, given_P_;  // to the displacements
    void run_layer(const Layer& next);
    void leave_parameters(const Shader& shader);
    void output(const KernelKey& first, const Item& value);  // `first`: of its component 0
    void light_outputs();

    std::span<const Layer> layers_;
    uint64_t jitter_ = 0;  // calls of jittered() so far
    std::unordered_map<const Symbol*, Storage> variables_;
    std::unordered_map<const Symbol*, const Symbol*> stands_for_;  // output parameters
    std::map<Global, Item> globals_;
    Item no_element_;  // of an array without elements
    Item returned_;
    int call_depth_ = 0;  // calls of recursive functions
    int calls_left_ = 0;
    int64_t statements_ = 0;  // run so far
    struct Source {
        const Stmt* stmt;
        Item L, Cl, Ol;
        bool lit;
        Item spread{BaseType::Float};
    };
    std::vector<Source> sources_;
    // What the layers that have run left.
    struct Left {
        std::map<std::pair<size_t, std::string>, Storage> parameters;  // by layer and name
        Vec<Real> Ci{}, Oi{};
        bool surface = false;
    };
    Left left_;
    int gathers_ = 0;
    std::vector<const Symbol*> changed_;  // since the observer was told
    const Function* function_ = nullptr;  // that runs
};

template <class Real>
bool Reference<Real>::in_cone(const Vec<Real>& L, const Vec<Real>* axis, const Number& angle) {
    if (!axis || angle.x >= Real(3.14159)) return true;
    Real lengths = length(*axis).x * length(L).x, along = dot(L, *axis).x;
    Real side = std::cos(angle.x) * lengths;
    // On the cone itself (a point on the axis of one without width) rounding decides.
    if (std::fabs(side - along) < Real(0x1p-21) * lengths) no_promise();
    return decide(side <= along);
}

template <class Real>
template <class F>
void Reference<Real>::for_each_light(const Vec<Real>* axis, const Number& angle, F&& f) {
    for (const ReferenceLight& l : in.lights) {
        if (l.kind == kLightAmbient || !l.lit) continue;
        Vec<Real> L = {Real(l.L[0]), Real(l.L[1]), Real(l.L[2])};
        if (in_cone(L, axis, angle)) f(l, L);
    }
}

}  // namespace kinora::rsl
