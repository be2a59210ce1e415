// rsl/lower/values.h: RSL values of any type as IR: conversions, operators, matrices and colors.
#pragma once

#include <string>
#include <string_view>

#include "rsl/lower/context.h"
#include "rsl/lower/math.h"

namespace kinora::rsl {

inline jit::Type ir_type(BaseType type) {
    return type == BaseType::String ? jit::Type::I
           : type == BaseType::Bool ? jit::Type::M
                                    : jit::Type::F;
}

Lowered zero(Emitter& e, BaseType type);
Lowered convert(Emitter& e, const Lowered& x, BaseType to);
Lowered binary(Emitter& e, Op op, const Lowered& x, const Lowered& y);
Value pick(Emitter& e, const V3& v, Value component);  // the component that an int names

// Matrices of four rows, for row vectors (matrix.cpp).
bool is_affine(Emitter& e, const Lowered& m);                   // known to be
V3 transform_point(Emitter& e, const V3& p, const Lowered& m);  // divided by w unless m is affine
V3 transform_vector(Emitter& e, const V3& v, const Lowered& m);
V3 transform_normal(Emitter& e, const V3& n, const Lowered& inverse);  // by the inverse, transposed
Lowered multiply(Emitter& e, const Lowered& a, const Lowered& m);
Lowered invert(Emitter& e, const Lowered& m);
Value determinant(Emitter& e, const Lowered& m);

// A color of one named space in another (color.cpp); unknown names are reported.
Lowered color_space(Emitter& e, LoweringContext& context, const Lowered& color,
                    std::string_view from, std::string_view to, Location where);

}  // namespace kinora::rsl
