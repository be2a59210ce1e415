// rsl/builtins_matrix.cpp: rows of the built-in table: matrices.
#include "rsl/builtin.h"

namespace kinora::rsl {

namespace {

const Builtin kRows[] = {
    {"mtransform", "m=sm m=ssm", nullptr, {}, kPure, 8, "A matrix from one space to another."},
    {"determinant", "f=m", nullptr, {}, kPure, 8, "Determinant."},
    {"translate", "m=mv", nullptr, {}, kPure, 4, "The matrix with a translation before it."},
    {"scale", "m=mv", nullptr, {}, kPure, 4, "The matrix with a scaling before it."},
};

}  // namespace

std::span<const Builtin> builtins_matrix() {
    return kRows;
}

}  // namespace kinora::rsl
