// rsl/lower/spaces.cpp: coordinate systems and matrices.
#include <algorithm>

#include "rsl/lower/lower_p.h"

namespace kinora::rsl {

namespace {

constexpr std::string_view kProjective[] = {"screen", "NDC", "raster"};
constexpr std::string_view kStandard[] = {"world", "object", "shader", "screen", "NDC", "raster"};

// Of displacements, as true displacement has it: the object's own space.
constexpr std::string_view kOfObject[] = {"current", "object", "shader"};

template <class List>
bool contains(const List& list, std::string_view name) {
    return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

}  // namespace

Lowering::Space Lowering::space(Value name, Location where) {
    if (!bends_normals()) return kernel_space(name, where);
    const std::string* text = constant_text(name);
    if (text && contains(kOfObject, *text)) return {};
    Space object = input_space("object"), other = kernel_space(name, where);
    if (other.identity) return {false, object.from_current, object.to_current};
    return {false, multiply(other.to_current, object.from_current),
            multiply(object.to_current, other.from_current)};
}

Lowering::Space Lowering::kernel_space(Value name, Location where) {
    const std::string* text = constant_text(name);
    if (!text) return variable_space(name);
    if (*text == "current" || (*text == "camera" && !options.of_vertices)) return {};
    if (options.spaces && *text != "camera" && !contains(kStandard, *text) &&
        !contains(*options.spaces, *text)) {
        unknown_space(*text, where);
        return {};
    }
    return input_space(*text);
}

// The inputs hold matrices on column vectors, RSL's are on row vectors: row and column change
// places.
Lowering::Space Lowering::input_space(const std::string& name) {
    bool of_point = kind() != ShaderKind::Light && (name == "object" || name == "shader");
    bool projective = contains(kProjective, name);
    auto matrix = [&](const char* direction) {
        Lowered m = convert(lowered(BaseType::Float, b.f(1)), BaseType::Matrix);
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < (projective ? 4 : 3); ++column)
                m.c[size_t(row * 4 + column)] =
                    scalar_input("space:" + name + ":" + direction + ":" + std::to_string(column) +
                                     std::to_string(row),
                                 jit::Type::F, of_point ? jit::Rate::Point : jit::Rate::Frame);
        return m;
    };
    return {false, matrix("to_current"), matrix("from_current")};
}

bool Lowering::bends_normals() const {
    return kind() == ShaderKind::Displacement && !layer->done &&
           layers.back().shader->kind == ShaderKind::Surface;
}

Lowered Lowering::into_layer(const Lowered& x) {
    if (!bends_normals() || !is_spatial(x.type)) return x;
    return from_current(x, input_space("object"));
}

Lowered Lowering::out_of_layer(const Lowered& x) {
    if (!bends_normals() || !is_spatial(x.type)) return x;
    return to_current(x, input_space("object"));
}

Lowered Lowering::from_object(const Lowered& x) {
    if (options.of_vertices || bends_normals() || !is_spatial(x.type)) return x;
    return to_current(x, input_space("object"));
}

void Lowering::unknown_space(const std::string& name, Location where) {
    std::vector<std::string_view> known(std::begin(kStandard), std::end(kStandard));
    known.push_back("current");
    known.push_back("camera");
    known.insert(known.end(), options.spaces->begin(), options.spaces->end());
    failed = true;
    Finding* finding = report(Code::RSL_SPACE_UNKNOWN, where, name);
    if (auto near = nearest_name(name, known); finding && !near.empty())
        finding->help = "did you mean '" + std::string(near) + "'?";
}

Lowering::Space Lowering::variable_space(Value name) {
    std::vector<Value> parts = service(Service::transform, std::span(&name, 1));
    auto matrix = [&](size_t first) {
        Lowered m = convert(lowered(BaseType::Float, b.f(1)), BaseType::Matrix);
        for (size_t row = 0; row < 4; ++row)
            for (size_t column = 0; column < 3; ++column)
                m.c[row * 4 + column] = parts[first + column * 4 + row];
        return m;
    };
    return {false, matrix(0), matrix(12)};
}

bool Lowering::is_affine(const Lowered& m) {
    float one = 0;
    return is_zero(m.c[3]) && is_zero(m.c[7]) && is_zero(m.c[11]) && b.constant_f(m.c[15], &one) &&
           one == 1;
}

V3 Lowering::transform_point(const V3& p, const Lowered& m) {
    auto column = [&](size_t k) {
        return fma(p[0], m.c[k], fma(p[1], m.c[4 + k], fma(p[2], m.c[8 + k], m.c[12 + k])));
    };
    V3 q = {column(0), column(1), column(2)};
    if (is_affine(m)) return q;
    Value w = column(3);
    return {div(q[0], w), div(q[1], w), div(q[2], w)};
}

V3 Lowering::transform_vector(const V3& v, const Lowered& m) {
    auto column = [&](size_t k) {
        return fma(v[0], m.c[k], fma(v[1], m.c[4 + k], mul(v[2], m.c[8 + k])));
    };
    return {column(0), column(1), column(2)};
}

V3 Lowering::transform_normal(const V3& n, const Lowered& inverse) {
    auto row = [&](size_t k) {
        return fma(n[0], inverse.c[4 * k],
                   fma(n[1], inverse.c[4 * k + 1], mul(n[2], inverse.c[4 * k + 2])));
    };
    return {row(0), row(1), row(2)};
}

Lowered Lowering::multiply(const Lowered& x, const Lowered& m) {
    Lowered r{BaseType::Matrix, {}};
    for (size_t i = 0; i < 4; ++i)
        for (size_t k = 0; k < 4; ++k)
            r.c[i * 4 + k] =
                fma(x.c[i * 4], m.c[k],
                    fma(x.c[i * 4 + 1], m.c[4 + k],
                        fma(x.c[i * 4 + 2], m.c[8 + k], mul(x.c[i * 4 + 3], m.c[12 + k]))));
    return r;
}

namespace {

// The 2x2 minors of the upper and lower two rows, as the Laplace expansion by pairs needs them.
struct Minors {
    std::array<Value, 6> upper, lower;
};

Minors minors(Emitter& e, const Lowered& m) {
    constexpr size_t kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    Minors result{};
    auto minor = [&](size_t row, size_t i, size_t k) {
        return e.b.sub(e.mul(m.c[row * 4 + i], m.c[row * 4 + 4 + k]),
                       e.mul(m.c[row * 4 + k], m.c[row * 4 + 4 + i]));
    };
    for (size_t p = 0; p < 6; ++p) {
        result.upper[p] = minor(0, kPairs[p][0], kPairs[p][1]);
        result.lower[p] = minor(2, kPairs[p][0], kPairs[p][1]);
    }
    return result;
}

Value determinant_of(Emitter& e, const Minors& n) {
    Value d = e.mul(n.upper[0], n.lower[5]);
    d = e.fma(e.b.neg(n.upper[1]), n.lower[4], d);
    d = e.fma(n.upper[2], n.lower[3], d);
    d = e.fma(n.upper[3], n.lower[2], d);
    d = e.fma(e.b.neg(n.upper[4]), n.lower[1], d);
    return e.fma(n.upper[5], n.lower[0], d);
}

}  // namespace

Value Lowering::determinant(const Lowered& m) {
    return determinant_of(*this, minors(*this, m));
}

// By cofactors; a singular matrix gives 0, by RSL's division.
Lowered Lowering::invert(const Lowered& m) {
    Minors n = minors(*this, m);
    Value scale = div(b.f(1), determinant_of(*this, n));
    auto& s = n.upper;
    auto& c = n.lower;
    // a*x - b*y + d*z
    auto cofactor = [&](size_t i, Value x, size_t j, Value y, size_t k, Value z) {
        Value sum = fma(m.c[k], z, fma(b.neg(m.c[j]), y, mul(m.c[i], x)));
        return mul(sum, scale);
    };
    auto negative = [&](Value v) { return b.neg(v); };
    Lowered r{BaseType::Matrix, {}};
    r.c[0] = cofactor(5, c[5], 6, c[4], 7, c[3]);
    r.c[1] = negative(cofactor(1, c[5], 2, c[4], 3, c[3]));
    r.c[2] = cofactor(13, s[5], 14, s[4], 15, s[3]);
    r.c[3] = negative(cofactor(9, s[5], 10, s[4], 11, s[3]));
    r.c[4] = negative(cofactor(4, c[5], 6, c[2], 7, c[1]));
    r.c[5] = cofactor(0, c[5], 2, c[2], 3, c[1]);
    r.c[6] = negative(cofactor(12, s[5], 14, s[2], 15, s[1]));
    r.c[7] = cofactor(8, s[5], 10, s[2], 11, s[1]);
    r.c[8] = cofactor(4, c[4], 5, c[2], 7, c[0]);
    r.c[9] = negative(cofactor(0, c[4], 1, c[2], 3, c[0]));
    r.c[10] = cofactor(12, s[4], 13, s[2], 15, s[0]);
    r.c[11] = negative(cofactor(8, s[4], 9, s[2], 11, s[0]));
    r.c[12] = negative(cofactor(4, c[3], 5, c[1], 6, c[0]));
    r.c[13] = cofactor(0, c[3], 1, c[1], 2, c[0]);
    r.c[14] = negative(cofactor(12, s[3], 13, s[1], 14, s[0]));
    r.c[15] = cofactor(8, s[3], 9, s[1], 10, s[0]);
    return r;
}

Lowered Lowering::to_current(const Lowered& x, const Space& from) {
    return change_space(x, from.identity, from.to_current, from.from_current);
}

Lowered Lowering::from_current(const Lowered& x, const Space& to) {
    return change_space(x, to.identity, to.from_current, to.to_current);
}

Lowered Lowering::change_space(const Lowered& x, bool identity, const Lowered& m,
                               const Lowered& inverse) {
    if (identity) return x;
    switch (x.type) {
        case BaseType::Point:
            return lowered(x.type, transform_point(x.v3(), m));
        case BaseType::Normal:
            return lowered(x.type, transform_normal(x.v3(), inverse));
        case BaseType::Matrix:
            return multiply(x, m);
        default:
            return lowered(x.type, transform_vector(x.v3(), m));
    }
}

}  // namespace kinora::rsl
