// rsl/reference/spaces.cpp: coordinate systems and matrices at one point.
#include <algorithm>

#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace {

template <class Real>
using Matrix = std::array<Dual<Real>, 16>;

template <class Real>
Matrix<Real> identity() {
    Matrix<Real> m{};
    for (size_t k = 0; k < 4; ++k) m[k * 5] = Real(1);
    return m;
}

template <class Real>
Matrix<Real> product(const Matrix<Real>& a, const Matrix<Real>& b) {
    Matrix<Real> r{};
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j)
            for (size_t k = 0; k < 4; ++k)
                r[i * 4 + j] = r[i * 4 + j] + a[i * 4 + k] * b[k * 4 + j];
    return r;
}

// By the first row, and so on for the minors.
template <class Real>
Dual<Real> determinant_of(const std::vector<Dual<Real>>& m, size_t n) {
    if (n == 1) return m[0];
    Dual<Real> sum;
    for (size_t j = 0; j < n; ++j) {
        std::vector<Dual<Real>> minor;
        for (size_t i = 1; i < n; ++i)
            for (size_t k = 0; k < n; ++k)
                if (k != j) minor.push_back(m[i * n + k]);
        Dual<Real> term = m[j] * determinant_of(minor, n - 1);
        sum = j % 2 ? sum - term : sum + term;
    }
    return sum;
}

// Cramer's rule; 0 for a singular matrix, by RSL's division.
template <class Real>
Matrix<Real> inverse_of(const Matrix<Real>& m) {
    Dual<Real> d = determinant_of(std::vector(m.begin(), m.end()), 4);
    Matrix<Real> r;
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j) {
            std::vector<Dual<Real>> minor;
            for (size_t a = 0; a < 4; ++a)
                for (size_t b = 0; b < 4; ++b)
                    if (a != i && b != j) minor.push_back(m[a * 4 + b]);
            Dual<Real> cofactor = determinant_of(minor, 3) / d;
            r[j * 4 + i] = (i + j) % 2 ? -cofactor : cofactor;
        }
    return r;
}

template <class Real>
Matrix<Real> matrix(const RefValue<Real>& a) {
    return a.c;
}

// RenderMan's rotation by the right hand, for row vectors.
template <class Real>
Matrix<Real> rotation(const Dual<Real>& angle, const Vec<Real>& axis) {
    Vec<Real> a = normalize(axis);
    Dual<Real> s = sin(angle), k = Dual<Real>(1) - cos(angle);
    Matrix<Real> m = identity<Real>();
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) m[i * 4 + j] = k * a[i] * a[j];
    for (size_t i = 0; i < 3; ++i) m[i * 5] = m[i * 5] + cos(angle);
    size_t next[] = {1, 2, 0};
    for (size_t i = 0; i < 3; ++i) {
        size_t j = next[i], l = next[j];
        m[i * 4 + j] = m[i * 4 + j] + s * a[l];
        m[j * 4 + i] = m[j * 4 + i] - s * a[l];
    }
    return m;
}

template <class Real>
RefValue<Real> moved(const Matrix<Real>& m) {
    RefValue<Real> r(BaseType::Matrix);
    r.c = m;
    return r;
}

}  // namespace

template <class Real>
bool Reference<Real>::bends_normals() const {
    return layer && layer->shader->kind == ShaderKind::Displacement &&
           layers_.back().shader->kind == ShaderKind::Surface;
}

template <class Real>
auto Reference<Real>::space(const std::string& name, const char* direction) const -> Matrix {
    if (!bends_normals()) return input_space(name, direction);
    bool to = direction[0] == 't';
    if (name == "current" || name == "object" || name == "shader") return identity<Real>();
    Matrix camera = input_space(name, direction);
    return to ? product(camera, input_space("object", "from_current"))
              : product(input_space("object", "to_current"), camera);
}

template <class Real>
auto Reference<Real>::into_layer(const Item& x) -> Item {
    bool other = bends_normals() && is_spatial(x.type);
    return other ? by_matrix(x, input_space("object", "from_current")) : x;
}
template <class Real>
auto Reference<Real>::out_of_layer(const Item& x) -> Item {
    bool other = bends_normals() && is_spatial(x.type);
    return other ? by_matrix(x, input_space("object", "to_current")) : x;
}
// What the mesh brings, in the layer's current.
template <class Real>
auto Reference<Real>::from_object(const Item& x) -> Item {
    bool other = !bends_normals() && is_spatial(x.type);
    return other ? by_matrix(x, input_space("object", "to_current")) : x;
}

// Inputs hold matrices on column vectors; ours are on row vectors.
template <class Real>
auto Reference<Real>::input_space(const std::string& name, const char* direction) const -> Matrix {
    Matrix m = identity<Real>();
    for (size_t row = 0; row < 4; ++row)
        for (size_t column = 0; column < 4; ++column)
            m[column * 4 + row] = number("space:" + name + ":" + direction + ":" +
                                             std::to_string(row) + std::to_string(column),
                                         m[column * 4 + row].x);
    return m;
}

// A point, vector, normal or matrix by a matrix, as its type asks.
template <class Real>
auto Reference<Real>::by_matrix(const Item& x, const Matrix& m) -> Item {
    if (x.type == BaseType::Matrix) return moved(product(x.c, m));
    Matrix n = m;
    if (x.type == BaseType::Normal) {  // by the transpose of the inverse
        Matrix i = inverse(m);
        for (size_t r = 0; r < 4; ++r)
            for (size_t c = 0; c < 4; ++c) n[r * 4 + c] = i[c * 4 + r];
    }
    Number w = x.type == BaseType::Point ? Number(1) : Number(0);
    Number y[4];
    for (size_t c = 0; c < 4; ++c)
        y[c] = x.c[0] * n[c] + x.c[1] * n[4 + c] + x.c[2] * n[8 + c] + w * n[12 + c];
    bool affine = m[3].x == 0 && m[7].x == 0 && m[11].x == 0 && m[15].x == 1;
    if (x.type == BaseType::Point && !affine)
        return {x.type, y[0] / y[3], y[1] / y[3], y[2] / y[3]};
    return {x.type, y[0], y[1], y[2]};
}

template <class Real>
auto Reference<Real>::inverse(const Matrix& m) -> Matrix {
    Matrix r = inverse_of(m);
    for (Number& x : r)
        if (x.x != std::floor(x.x)) x = rounded(x);
    return r;
}

template <class Real>
auto Reference<Real>::to_space(const Item& x, const std::string& from, const std::string& to)
    -> Item {
    return by_matrix(by_matrix(x, space(from, "to_current")), space(to, "from_current"));
}

namespace ref {

namespace {

// transform(to, x), (from, to, x), (m, x), (from, m, x); the result has the function's type.
template <class Real>
void move(RefCall<Real>& c, BaseType type) {
    RefValue<Real> x = c.args.back();
    x.type = type;
    const RefValue<Real>& last = c.args[c.args.size() - 2];
    std::string from = c.args.size() == 3 ? c.text(0) : "current";
    if (last.type == BaseType::String) {
        c.result = c.eval.to_space(x, from, last.text());
        return;
    }
    x = c.eval.by_matrix(x, c.eval.space(from, "to_current"));
    c.result = c.eval.by_matrix(x, last.c);
}

}  // namespace

template <class Real>
void transform(RefCall<Real>& c) {
    move(c, BaseType::Point);
}
template <class Real>
void vtransform(RefCall<Real>& c) {
    move(c, BaseType::Vector);
}
template <class Real>
void ntransform(RefCall<Real>& c) {
    move(c, BaseType::Normal);
}
template <class Real>
void mtransform(RefCall<Real>& c) {
    move(c, BaseType::Matrix);
}

// rotate(p, angle, p0, p1) around a line, or rotate(m, angle, axis).
template <class Real>
void rotate(RefCall<Real>& c) {
    if (c.args[0].type == BaseType::Matrix) {
        c.result = moved(product(rotation(c.f(1), c.v(2)), matrix(c.args[0])));
        return;
    }
    Vec<Real> p = c.v(2), q = c.v(0) - p;
    RefValue<Real> d(BaseType::Vector, q[0], q[1], q[2]);
    c.set(p + vec(c.eval.by_matrix(d, rotation(c.f(1), c.v(3) - p))));
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

template <class Real>
void determinant(RefCall<Real>& c) {
    Matrix<Real> m = matrix(c.args[0]);
    c.set(determinant_of(std::vector(m.begin(), m.end()), 4));
}

KINORA_RSL_DEFINE_REF(transform)
KINORA_RSL_DEFINE_REF(vtransform)
KINORA_RSL_DEFINE_REF(ntransform)
KINORA_RSL_DEFINE_REF(mtransform)
KINORA_RSL_DEFINE_REF(rotate)
KINORA_RSL_DEFINE_REF(translate)
KINORA_RSL_DEFINE_REF(scale)
KINORA_RSL_DEFINE_REF(determinant)

}  // namespace ref

#define KINORA_SPACE_METHODS(Real)                                                               \
    template bool Reference<Real>::bends_normals() const;                                        \
    template auto Reference<Real>::space(const std::string&, const char*) const->Matrix;         \
    template auto Reference<Real>::input_space(const std::string&, const char*) const->Matrix;   \
    template auto Reference<Real>::into_layer(const Item&)->Item;                                \
    template auto Reference<Real>::out_of_layer(const Item&)->Item;                              \
    template auto Reference<Real>::from_object(const Item&)->Item;                               \
    template auto Reference<Real>::by_matrix(const Item&, const Matrix&)->Item;                  \
    template auto Reference<Real>::inverse(const Matrix&)->Matrix;                               \
    template auto Reference<Real>::to_space(const Item&, const std::string&, const std::string&) \
        ->Item;
KINORA_SPACE_METHODS(float)
KINORA_SPACE_METHODS(double)

}  // namespace kinora::rsl
