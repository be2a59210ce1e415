// rsl/reference/spaces.cpp: coordinate systems at one point.
#include <algorithm>
#include <set>

#include "rsl/reference/matrices_p.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

template <class Real>
bool Reference<Real>::bends_normals() const {
    return layer && layer->shader->kind == ShaderKind::Displacement &&
           layers_.back().shader->kind == ShaderKind::Surface;
}

template <class Real>
auto Reference<Real>::space(const std::string& named, const char* direction) const -> Matrix {
    static const std::set<std::string> kStandard = {"current", "camera", "world", "object",
                                                    "shader",  "screen", "NDC",   "raster"};
    bool known = !in.spaces || kStandard.contains(named) ||
                 std::find(in.spaces->begin(), in.spaces->end(), named) != in.spaces->end();
    const std::string name = known ? named : "shader";
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
    KernelKey key = space_key(name, direction[0] == 't', 0, 0);
    for (size_t row = 0; row < 4; ++row)
        for (size_t column = 0; column < 4; ++column) {
            key.component = uint8_t(row * 4 + column);
            m[column * 4 + row] = number(key, m[column * 4 + row].x);
        }
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
