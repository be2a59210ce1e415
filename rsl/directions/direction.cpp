// rsl/directions/direction.cpp: multiples, opposites and choices between N and -N.
#include "rsl/directions/direction.h"

#include <utility>

#include "rsl/model/kernel_keys.h"

namespace kinora::rsl {

namespace {

using jit::Inst;

using jit::Value;
using V3 = std::array<Value, 3>;

constexpr struct {
    Global global;
    Base base;
} kBases[] = {{Global::N, Base::N}, {Global::Ng, Base::Ng}, {Global::I, Base::I}};

class DirectionFinder {
  public:
    explicit DirectionFinder(jit::Builder& b) : b_(b) {}

    Direction of(const V3& v) {
        if (--steps_ < 0) return {};
        for (const auto& row : kBases)
            if (is_input(v, row.global)) return {row.base};
        const Inst& x = b_.inst(v[0]);
        for (Value component : v)
            if (b_.inst(component).op != x.op || b_.inst(component).imm != x.imm) return {};
        if (x.op == jit::Op::Neg) return opposite(of(operands(v, &Inst::a)));
        if (x.op == jit::Op::Mul) return scaled(v);
        if (x.op == jit::Op::Div && same(operands(v, &Inst::b)) && b_.constant_f(x.b))
            return positive(x.b, v) ? of(operands(v, &Inst::a)) : Direction{};
        if (x.op == jit::Op::Merge)
            return either(b_.inst(Value(x.imm)).a, operands(v, &Inst::a), operands(v, &Inst::b));
        if (x.op == jit::Op::Select && same(operands(v, &Inst::a)))
            return either(x.a, operands(v, &Inst::b), operands(v, &Inst::c));
        return {};
    }

  private:
    bool is_input(const V3& v, Global global) {
        for (int c = 0; c < 3; ++c) {
            const Inst* x = &b_.inst(v[size_t(c)]);
            if (x->op == jit::Op::WithSlope) x = &b_.inst(x->a);
            if (x->op != jit::Op::Input) return false;
            if (key_of(b_.module().inputs[size_t(x->imm)]) != global_key(global, c)) return false;
        }
        return true;
    }
    V3 operands(const V3& v, Value Inst::*which) {
        return {b_.inst(v[0]).*which, b_.inst(v[1]).*which, b_.inst(v[2]).*which};
    }
    static bool same(const V3& v) { return v[0] == v[1] && v[0] == v[2]; }
    static Direction opposite(Direction d) {
        d.opposite = !d.opposite;
        return d;
    }
    bool is_zero(Value v) {
        float x;
        return b_.constant_f(v, &x) && x == 0;
    }

    // A vector times one number.
    Direction scaled(const V3& v) {
        const Inst& first = b_.inst(v[0]);
        for (Value factor : {first.b, first.a}) {
            V3 rest;
            bool common = true;
            for (size_t k = 0; k < 3; ++k) {
                const Inst& x = b_.inst(v[k]);
                common &= x.a == factor || x.b == factor;
                rest[k] = x.b == factor ? x.a : x.b;
            }
            if (common && positive(factor, rest)) return of(rest);
        }
        return {};
    }

    // Whether a factor of the vector is greater than 0 wherever the vector is not 0.
    bool positive(Value factor, const V3& vector) {
        float x;
        if (b_.constant_f(factor, &x)) return x > 0;
        const Inst& choice = b_.inst(factor);
        if (choice.op != jit::Op::Select) return false;
        if (b_.constant_f(choice.b, &x) && x > 0) return positive(choice.c, vector);
        return is_inverse_length(choice, vector);
    }
    // As Emitter::normalize() writes it: s > 0 ? 1 / sqrt(s) : 0, s the vector's square.
    bool is_inverse_length(const Inst& choice, const V3& vector) {
        const Inst &above = b_.inst(choice.a), &inverse = b_.inst(choice.b);
        if (above.op != jit::Op::Lt || !is_zero(above.a) || !is_zero(choice.c)) return false;
        if (inverse.op != jit::Op::Div) return false;
        const Inst& root = b_.inst(inverse.b);
        float one;
        return b_.constant_f(inverse.a, &one) && one > 0 && root.op == jit::Op::Sqrt &&
               root.a == above.b && is_square(root.a, vector);
    }
    bool is_square(Value square, const V3& v) {
        const Inst& x = b_.inst(square);
        if (x.op == jit::Op::Merge && b_.inst(v[0]).op == jit::Op::Merge)
            return b_.inst(v[0]).imm == x.imm && is_square(x.b, operands(v, &Inst::b));
        V3 left, right;
        return is_dot(square, left, right) && left == v && right == v;
    }
    // As Emitter::dot() writes it.
    bool is_dot(Value value, V3& left, V3& right) {
        for (size_t k = 0; k < 3; ++k) {
            const Inst& x = b_.inst(value);
            if (x.op != (k < 2 ? jit::Op::Fma : jit::Op::Mul)) return false;
            left[k] = x.a, right[k] = x.b;
            value = x.c;
        }
        return true;
    }

    // mask ? x : y
    Direction either(Value mask, const V3& x, const V3& y) {
        const Direction then = of(x);
        if (then.base == Base::None) return {};
        const Direction otherwise = of(y);
        if (then == otherwise) return then;
        if (then.base != Base::N || then.faced != Base::None || otherwise != opposite(then))
            return {};
        bool along_I = false;
        const Base faced = judge(mask, along_I);
        if (faced == Base::None) return {};
        return {Base::N, then.opposite != along_I, faced};
    }
    // The global that a mask compares with I, and whether it is set where the two point the same
    // way (else where they are against each other).
    Base judge(Value mask, bool& along) {
        const Inst& x = b_.inst(mask);
        if (x.op == jit::Op::MNot) {
            const Base judged = judge(x.a, along);
            along = !along;
            return judged;
        }
        if (x.op != jit::Op::Lt && x.op != jit::Op::Le) return Base::None;
        along = is_zero(x.a);
        if (!along && !is_zero(x.b)) return Base::None;
        V3 left, right;
        if (!is_dot(along ? x.b : x.a, left, right)) return Base::None;
        Direction judged = of(left), ray = of(right);
        if (judged.base == Base::I) std::swap(judged, ray);
        if (ray.base != Base::I || judged.base == Base::I || judged.faced != Base::None)
            return Base::None;
        along = along != (judged.opposite != ray.opposite);
        return judged.base;
    }

    jit::Builder& b_;
    int steps_ = 200;
};

}  // namespace

Direction direction_of(jit::Builder& b, const V3& v) {
    return DirectionFinder(b).of(v);
}

}  // namespace kinora::rsl
