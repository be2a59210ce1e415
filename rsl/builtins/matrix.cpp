// rsl/builtins/matrix.cpp: matrices.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/reference/matrices_p.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_matrix {

// mtransform("to", m), mtransform("from", "to", m)
void mtransform(LowerCall& c) {
    auto space = [&](size_t k) {
        return c.spaces.space(c.args[k].c[0], c.call.args[k]->span.where);
    };
    Lowered m = c.args.back();
    if (c.args.size() == 3) m = c.spaces.to_current(m, space(0));
    c.result = c.spaces.from_current(m, space(c.args.size() - 2));
}
void determinant(LowerCall& c) {
    c.set(determinant(c.e, c.args[0]));
}
// The row vector (x, y, z, 1) times m takes the place of m's last row.
void translate(LowerCall& c) {
    Lowered m = c.args[0];
    V3 t = c.v3(1);
    for (size_t k = 0; k < 4; ++k)
        m.c[12 + k] = c.e.fma(t[0], m.c[k],
                              c.e.fma(t[1], m.c[4 + k], c.e.fma(t[2], m.c[8 + k], m.c[12 + k])));
    c.result = m;
}
void scale(LowerCall& c) {
    Lowered m = c.args[0];
    for (size_t row = 0; row < 3; ++row)
        for (size_t k = 0; k < 4; ++k)
            m.c[row * 4 + k] = c.e.mul(m.c[row * 4 + k], c.args[1].c[row]);
    c.result = m;
}

}  // namespace lower_matrix

namespace ref {
namespace {

template <class Real>
void mtransform(RefCall<Real>& c) {
    change_space(c, BaseType::Matrix);
}

template <class Real>
void determinant(RefCall<Real>& c) {
    Matrix<Real> m = matrix(c.args[0]);
    c.set(determinant_of(std::vector(m.begin(), m.end()), 4));
}

template <class Real>
void translate(RefCall<Real>& c) {
    Matrix<Real> m = identity<Real>();
    for (size_t k = 0; k < 3; ++k) m[12 + k] = c.v(1)[k];
    c.result = moved(product(m, matrix(c.args[0])));
}

template <class Real>
void scale(RefCall<Real>& c) {
    Matrix<Real> m = identity<Real>();
    for (size_t k = 0; k < 3; ++k) m[k * 5] = c.v(1)[k];
    c.result = moved(product(m, matrix(c.args[0])));
}

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_matrix;

const Builtin kRows[] = {
    {"mtransform", "m=sm m=ssm", lower::mtransform, KINORA_RSL_REF(ref::mtransform), kPure, 8,
     "A matrix from one space to another."},
    {"determinant", "f=m", lower::determinant, KINORA_RSL_REF(ref::determinant), kPure, 8,
     "Determinant."},
    {"translate", "m=mv", lower::translate, KINORA_RSL_REF(ref::translate), kPure, 4,
     "The matrix with a translation before it."},
    {"scale", "m=mv", lower::scale, KINORA_RSL_REF(ref::scale), kPure, 4,
     "The matrix with a scaling before it."},
};

}  // namespace

std::span<const Builtin> builtins_matrix() {
    return kRows;
}

}  // namespace kinora::rsl
