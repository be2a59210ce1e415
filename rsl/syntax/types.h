// rsl/syntax/types.h: the types, details and rates of the shading language.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kinora::rsl {

// Bool is internal: the type of comparisons, `!`, `&&`, `||` and of every condition. The checker
// puts Cast nodes where a Bool meets a Float (0 or 1) or a Float meets a condition (x != 0).
// Invalid marks an expression that already has a finding; it never survives a successful check.
enum class BaseType : uint8_t {
    Float,
    Color,
    Point,
    Vector,
    Normal,
    Matrix,
    String,
    Void,
    Bool,
    Invalid,
};

// array_length: -1 = no array, 0 = unsized (`float a[]`: parameters of functions, and resizable
// arrays), else elements.
struct Type {
    BaseType base = BaseType::Void;
    int array_length = -1;

    bool operator==(const Type&) const = default;
    constexpr bool is_array() const { return array_length >= 0; }
    constexpr Type element() const { return {base, -1}; }
};

enum class ShaderKind : uint8_t { Surface, Displacement, Light, Volume, Imager, Transformation };
const char* shader_kind_name(ShaderKind kind);  // "surface"

// What the source says of a variable. Unspecified: parameters of a shader are uniform, locals and
// function parameters take the rate of what is assigned to them.
enum class Detail : uint8_t { Unspecified, Uniform, Varying };

// What the checker finds out. Constant: known without running. Uniform: one value a shader instance
// and frame. Varying: one value a point. The order is the join: max(a, b).
enum class Rate : uint8_t { Constant, Uniform, Varying };

constexpr bool is_triple(BaseType b) {
    return b >= BaseType::Color && b <= BaseType::Normal;
}
constexpr bool is_spatial(BaseType b) {
    return b >= BaseType::Point && b <= BaseType::Normal;
}
constexpr bool is_numeric(BaseType b) {
    return b <= BaseType::Matrix;
}
constexpr bool is_triple(Type t) {
    return !t.is_array() && is_triple(t.base);
}

// Floats that one element takes: 1, 3 or 16; 1 for a String (its intern index) and a Bool; 0 for
// Void.
constexpr int component_count(BaseType b) {
    return is_triple(b) ? 3 : b == BaseType::Matrix ? 16 : b == BaseType::Void ? 0 : 1;
}

const char* type_name(BaseType base);    // "color"
std::string type_name(Type type);        // "color[4]", "float[]"
const char* detail_name(Detail detail);  // "uniform", "varying", "" if unspecified
const char* rate_name(Rate rate);        // "constant", "uniform", "varying"

// The RSL keyword's type ("color", ..., "void"); Invalid for any other word.
BaseType type_from_name(std::string_view word);

}  // namespace kinora::rsl
