// rsl/lower/spaces.cpp: coordinate systems.
#include "rsl/lower/spaces.h"

#include <algorithm>

#include "rsl/lower/services.h"
#include "rsl/lower/values.h"

namespace kinora::rsl {

namespace {

constexpr std::string_view kProjective[] = {"screen", "NDC", "raster"};
constexpr std::string_view kStandard[] = {"world",  "object", "shader", "current",
                                          "camera", "screen", "NDC",    "raster"};

// Of displacements, as true displacement has it: the object's own space.
constexpr std::string_view kOfObject[] = {"current", "object", "shader"};

template <class List>
bool contains(const List& list, std::string_view name) {
    return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

}  // namespace

Space Spaces::space(Value name, Location where) {
    const std::string* text = e_.constant_text(name);
    std::string meant = text ? meant_space(*text, where) : "";
    if (text) text = &meant;
    if (!context_.bends_normals()) return kernel_space(name, text);
    if (text && contains(kOfObject, meant) && !has_own_space(meant)) return {};
    Space object = input_space("object"), other = kernel_space(name, text);
    if (other.identity) return {false, object.from_current, object.to_current};
    return {false, multiply(e_, other.to_current, object.from_current),
            multiply(e_, object.to_current, other.from_current)};
}

std::string Spaces::meant_space(const std::string& name, Location where) {
    if (contains(kStandard, name)) return name;
    if (!context_.options.spaces) {  // any name may be that of a node
        hint_at_near_name(name, where);
        return name;
    }
    if (contains(*context_.options.spaces, name)) return name;
    unknown_space(name, where);
    return "shader";
}

// "shader", where that is not the object's.
bool Spaces::has_own_space(std::string_view name) const {
    return name == "shader" && !context_.layer->space.empty();
}

Space Spaces::kernel_space(Value name, const std::string* meant) {
    if (!meant) return variable_space(name);
    if (has_own_space(*meant)) return input_space(context_.layer->space);
    if (*meant == "current" || (*meant == "camera" && !context_.options.of_vertices)) return {};
    return input_space(*meant);
}

// The inputs hold matrices on column vectors, RSL's are on row vectors: row and column change
// places.
Space Spaces::input_space(const std::string& name) {
    bool of_point = context_.kind() != ShaderKind::Light && (name == "object" || name == "shader");
    bool projective = contains(kProjective, name);
    auto matrix = [&](bool to_current) {
        Lowered m = convert(e_, lowered(BaseType::Float, b_.f(1)), BaseType::Matrix);
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < (projective ? 4 : 3); ++column)
                m.c[size_t(row * 4 + column)] =
                    scalar_input(b_, space_key(name, to_current, column, row), jit::Type::F,
                                 of_point ? jit::Rate::Point : jit::Rate::Frame);
        return m;
    };
    return {false, matrix(true), matrix(false)};
}

Lowered Spaces::into_layer(const Lowered& x) {
    if (!context_.bends_normals() || !is_spatial(x.type)) return x;
    return from_current(x, input_space("object"));
}

Lowered Spaces::out_of_layer(const Lowered& x) {
    if (!context_.bends_normals() || !is_spatial(x.type)) return x;
    return to_current(x, input_space("object"));
}

Lowered Spaces::from_object(const Lowered& x) {
    if (context_.options.of_vertices || context_.bends_normals() || !is_spatial(x.type)) return x;
    return to_current(x, input_space("object"));
}

void Spaces::unknown_space(const std::string& name, Location where) {
    std::vector<std::string_view> known(std::begin(kStandard), std::end(kStandard));
    known.insert(known.end(), context_.options.spaces->begin(), context_.options.spaces->end());
    Finding* finding = context_.report_first(Code::RSL_SPACE_UNKNOWN, where, name);
    if (!finding) return;
    context_.failed |= finding->severity == Severity::Error;  // as --strict wants it
    if (auto near = nearest_name(name, known); !near.empty())
        finding->help = "did you mean '" + std::string(near) + "'?";
}

// "shadr" is a mistake, "camera1" a node.
void Spaces::hint_at_near_name(const std::string& name, Location where) {
    std::vector<std::string_view> standard(std::begin(kStandard), std::end(kStandard));
    std::string_view near = nearest_name(name, standard);
    size_t letters = name.find_last_not_of("0123456789._") + 1;
    if (near.empty() || name.substr(0, letters) == near) return;
    if (Finding* finding = context_.report_first(Code::RSL_SPACE_NEAR, where, name))
        finding->help = "did you mean '" + std::string(near) + "'?";
}

Space Spaces::variable_space(Value name) {
    std::vector<Value> parts = kernel_service(e_, Service::transform, std::span(&name, 1));
    auto matrix = [&](size_t first) {
        Lowered m = convert(e_, lowered(BaseType::Float, b_.f(1)), BaseType::Matrix);
        for (size_t row = 0; row < 4; ++row)
            for (size_t column = 0; column < 3; ++column)
                m.c[row * 4 + column] = parts[first + column * 4 + row];
        return m;
    };
    return {false, matrix(0), matrix(12)};
}

Lowered Spaces::to_current(const Lowered& x, const Space& from) {
    return change_space(x, from.identity, from.to_current, from.from_current);
}

Lowered Spaces::from_current(const Lowered& x, const Space& to) {
    return change_space(x, to.identity, to.from_current, to.to_current);
}

Lowered Spaces::change_space(const Lowered& x, bool identity, const Lowered& m,
                             const Lowered& inverse) {
    if (identity) return x;
    switch (x.type) {
        case BaseType::Point:
            return lowered(x.type, transform_point(e_, x.v3(), m));
        case BaseType::Normal:
            return lowered(x.type, transform_normal(e_, x.v3(), inverse));
        case BaseType::Matrix:
            return multiply(e_, x, m);
        default:
            return lowered(x.type, transform_vector(e_, x.v3(), m));
    }
}

}  // namespace kinora::rsl
