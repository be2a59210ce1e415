// runtime/grid.cpp: from hits to the columns that kernels read.
#include "runtime/grid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/sampling.h"
#include "runtime/scene.h"
#include "runtime/shading_p.h"

namespace kinora {

void want_columns(Grid& grid, std::span<const uint16_t> wanted) {
    for (uint16_t column : wanted)
        if (!grid.columns[column])
            grid.columns[column] = grid.arena->allocate_span<float>(padded(grid.count())).data();
}

void want_triple(Grid& grid, uint16_t first) {
    uint16_t wanted[] = {first, uint16_t(first + 1), uint16_t(first + 2)};
    want_columns(grid, wanted);
}

namespace {

// A hit's triangle with everything interpolation needs.
struct Corner {
    const Surface& surface;
    const Shape& shape;
    const Mesh& mesh;
    const MeshGroup& group;
    uint32_t primitive;
    float u, v;  // barycentrics of corners 1 and 2

    uint32_t position(int k) const { return group.triangles[3 * primitive + uint32_t(k)]; }
    vec3 normal(int k) const {
        return vec3(shape.rest_normals[group.normal_corners[3 * primitive + uint32_t(k)]]);
    }
    const float* attribute(const VertexAttribute& a, int k) const {
        return &a.values[size_t(a.corners[3 * primitive + uint32_t(k)]) * a.stride];
    }
};

// Partial derivatives along u, v of what varies linearly over a triangle by d1, d2 along its edges:
// d1 = du1 x_u + dv1 x_v, d2 = du2 x_u + dv2 x_v, solved (DESIGN.md decision 9).
struct AffineMap {
    float inv[2][2] = {{1, 0}, {0, 1}};
    template <class T>
    T along_u(T d1, T d2) const {
        return inv[0][0] * d1 + inv[0][1] * d2;
    }
    template <class T>
    T along_v(T d1, T d2) const {
        return inv[1][0] * d1 + inv[1][1] * d2;
    }
};

struct Parameters {
    float s, t, u, v;
    AffineMap map;
};

Parameters parameters(const Corner& c) {
    Parameters p{c.u, c.v, c.u, c.v, {}};
    const VertexAttribute* st = c.surface.st;
    if (!st || st->stride < 2) return p;
    const float* a = c.attribute(*st, 0);
    const float* b = c.attribute(*st, 1);
    const float* d = c.attribute(*st, 2);
    float du1 = b[0] - a[0], dv1 = b[1] - a[1], du2 = d[0] - a[0], dv2 = d[1] - a[1];
    p.s = a[0] + c.u * du1 + c.v * du2;
    p.t = a[1] + c.u * dv1 + c.v * dv2;
    float det = du1 * dv2 - du2 * dv1;
    float scale = std::max(std::abs(du1 * dv2), std::abs(du2 * dv1));
    if (!(std::abs(det) > 1e-6f * scale) || !(std::abs(det) > 1e-30f)) return p;
    p.u = p.s;
    p.v = p.t;
    p.map.inv[0][0] = dv2 / det;
    p.map.inv[0][1] = -dv1 / det;
    p.map.inv[1][0] = -du2 / det;
    p.map.inv[1][1] = du1 / det;
    return p;
}

// The footprint in u, v of a displacement dP on the surface: least squares on dPdu, dPdv.
vec2 footprint(vec3 dPdu, vec3 dPdv, vec3 dP) {
    float a = glm::dot(dPdu, dPdu), b = glm::dot(dPdu, dPdv), c = glm::dot(dPdv, dPdv);
    float det = a * c - b * b;
    if (!(det > 0)) return vec2(0);
    float x = glm::dot(dPdu, dP), y = glm::dot(dPdv, dP);
    return vec2((c * x - b * y) / det, (a * y - b * x) / det);
}

// Cofactor of the linear part: takes normals along (EXTREMES.md 1c), the mirror's sign taken out.
mat3 normal_matrix(const dmat4& m, bool mirrored) {
    dmat3 l(m);
    dmat3 cofactor(glm::cross(l[1], l[2]), glm::cross(l[2], l[0]), glm::cross(l[0], l[1]));
    return mat3(mirrored ? -cofactor : cofactor);
}

class Gather {
  public:
    Gather(Grid& grid, const mat3& rotation, vec3 eye)
        : grid_(grid), scene_(grid.scene), rotation_(rotation), eye_(eye) {
        auto any = [&](std::initializer_list<int> columns) {
            for (int c : columns)
                if (grid.columns[size_t(c)]) return true;
            return false;
        };
        partials_ = any({kColdPdu, kColdPdv, kColDu, kColDv, kColdIdu, kColdIdv});
        normal_partials_ = any({kColdNdu, kColdNdv});
        parameters_ = partials_ || normal_partials_ || !grid.look->varying.empty() ||
                      any({kColU, kColV, kColS, kColT});
        matrices_ = any({kColToCurrent, kColFromCurrent}) ||
                    std::any_of(grid.columns.begin() + kColToCurrent,
                                grid.columns.begin() + kColVarying, [](float* c) { return c; });
        dPdx_ = any({kColDu, kColDv});
    }

    void point(size_t i) {
        uint32_t hit = grid_.points[i];
        uint32_t row = grid_.hits.instance[hit];
        if (row != row_) enter(row);
        const Surface& surface = scene_.surfaces[row];
        Corner corner{surface,
                      *shape_,
                      *mesh_,
                      mesh_->groups[surface.group],
                      grid_.hits.primitive[hit],
                      grid_.hits.u[hit],
                      grid_.hits.v[hit]};
        vec3 Ng = rotation_ * triple(grid_.hits.Ng, hit);
        place(i, hit);
        put(kColNg, i, Ng);
        normal(i, corner, Ng);
        if (parameters_) uv(i, hit, corner);
        if (matrices_) matrices(i);
        if (float* rng = grid_.columns[kColRng]) rng[i] = jit::float_of(int32_t(random(hit)));
    }

    void constants() {
        auto fill = [&](int column, float value) {
            if (float* c = grid_.columns[size_t(column)])
                std::fill_n(c, padded(grid_.count()), value);
        };
        fill(kColOne, 1.0f);
        fill(kColdsdu, 1.0f);
        fill(kColdsdv, 0.0f);
        fill(kColdtdu, 0.0f);
        fill(kColdtdv, 1.0f);
    }

  private:
    void put(int column, size_t i, vec3 value) {
        for (int k = 0; k < 3; ++k)
            if (float* c = grid_.columns[size_t(column + k)]) c[i] = value[k];
    }
    void put_float(int column, size_t i, float value) {
        if (float* c = grid_.columns[size_t(column)]) c[i] = value;
    }

    // Caches what all hits of one row share.
    void enter(uint32_t row) {
        row_ = row;
        shape_ = &scene_.shapes[scene_.surfaces[row].shape];
        mesh_ = &scene_.meshes[shape_->mesh];
        instanced_ = shape_->kind == raytrace::GeometryKind::Instanced;
        if (instanced_) {
            linear_ = rotation_ * mat3(dmat3(shape_->world));
            normals_ = rotation_ * normal_matrix(shape_->world, shape_->mirrored);
        } else {
            linear_ = normals_ = rotation_;
        }
        if (matrices_) {
            dmat4 to = scene_.view.camera_from_world * scene_.nodes[shape_->node].world;
            to_current_ = mat4(to);
            from_current_ = mat4(glm::inverse(to));
        }
    }

    void place(size_t i, uint32_t hit) {
        vec3 P = triple(grid_.hits.P, hit);
        put(kColP, i, rotation_ * (P - eye_));
        put(kColI, i, rotation_ * (P - triple(grid_.hits.org, hit)));
    }

    void normal(size_t i, const Corner& c, vec3 Ng) {
        if (!grid_.columns[kColN] && !grid_.columns[kColN + 1] && !grid_.columns[kColN + 2]) return;
        vec3 n0 = c.normal(0), n1 = c.normal(1), n2 = c.normal(2);
        vec3 N = normals_ * ((1 - c.u - c.v) * n0 + c.u * n1 + c.v * n2);
        float length = glm::length(N);
        // A normal that vanishes gives way to the geometric one (EXTREMES row 9).
        put(kColN, i, length > 0 && std::isfinite(length) ? N / length : Ng);
    }

    void uv(size_t i, uint32_t hit, const Corner& c) {
        Parameters p = parameters(c);
        put_float(kColU, i, p.u);
        put_float(kColV, i, p.v);
        put_float(kColS, i, p.s);
        put_float(kColT, i, p.t);
        varying(i, c, p.map);
        if (normal_partials_) normal_partials(i, c, p.map);
        if (!partials_) return;
        std::span<const vec4> x = shape_->rest_positions;
        vec3 p0(x[c.position(0)]), p1(x[c.position(1)]), p2(x[c.position(2)]);
        vec3 e1 = linear_ * (p1 - p0), e2 = linear_ * (p2 - p0);
        vec3 dPdu = p.map.along_u(e1, e2), dPdv = p.map.along_v(e1, e2);
        put(kColdPdu, i, dPdu);
        put(kColdPdv, i, dPdv);
        put(kColdIdu, i, dPdu);
        put(kColdIdv, i, dPdv);
        if (!dPdx_) return;
        vec2 x_step = footprint(dPdu, dPdv, rotation_ * triple(grid_.hits.dPdx, hit));
        vec2 y_step = footprint(dPdu, dPdv, rotation_ * triple(grid_.hits.dPdy, hit));
        put_float(kColDu, i, std::max(std::abs(x_step.x), std::abs(y_step.x)));
        put_float(kColDv, i, std::max(std::abs(x_step.y), std::abs(y_step.y)));
    }

    // Of the unit normal n = m / |m|: n_u = (m_u - n (n . m_u)) / |m|.
    void normal_partials(size_t i, const Corner& c, const AffineMap& map) {
        vec3 n0 = normals_ * c.normal(0), n1 = normals_ * c.normal(1), n2 = normals_ * c.normal(2);
        vec3 m = (1 - c.u - c.v) * n0 + c.u * n1 + c.v * n2;
        float length = glm::length(m);
        vec3 n = length > 0 ? m / length : vec3(0);
        auto partial = [&](vec3 d) {
            return length > 0 ? (d - n * glm::dot(n, d)) / length : vec3(0);
        };
        put(kColdNdu, i, partial(map.along_u(n1 - n0, n2 - n0)));
        put(kColdNdv, i, partial(map.along_v(n1 - n0, n2 - n0)));
    }

    void varying(size_t i, const Corner& c, const AffineMap& map) {
        for (size_t k = 0; k < grid_.look->varying.size(); ++k) {
            const VaryingParam& param = grid_.look->varying[k];
            const VertexAttribute* attribute = c.surface.varying[k];
            for (uint32_t j = 0; j < param.components; ++j) {
                float x[3] = {0, 0, 0};
                for (int corner = 0; corner < 3; ++corner) {
                    if (attribute) {
                        uint32_t from = std::min(param.component + j, attribute->stride - 1);
                        x[corner] = c.attribute(*attribute, corner)[from];
                    } else if (param.semantic == "Pref") {
                        x[corner] = c.mesh.positions[c.position(corner)][int(j)] +
                                    float(c.mesh.anchor[int(j)]);
                    }
                }
                float d1 = x[1] - x[0], d2 = x[2] - x[0];
                put_float(param.column + int(j), i, x[0] + c.u * d1 + c.v * d2);
                put_float(param.column + int(param.components + j), i, map.along_u(d1, d2));
                put_float(param.column + int(2 * param.components + j), i, map.along_v(d1, d2));
            }
        }
    }

    void matrices(size_t i) {
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column) {
                put_float(kColToCurrent + row * 4 + column, i, to_current_[column][row]);
                put_float(kColFromCurrent + row * 4 + column, i, from_current_[column][row]);
            }
    }

    uint32_t random(uint32_t hit) const {
        const raytrace::HitBatch& h = grid_.hits;
        uint32_t pixel = raytrace::hash(h.pixel_x[hit], h.pixel_y[hit]);
        return raytrace::hash(pixel, h.sample[hit], h.layer[hit] + 64 * h.depth);
    }

    Grid& grid_;
    const Scene& scene_;
    mat3 rotation_;
    vec3 eye_;
    bool partials_, normal_partials_, parameters_, matrices_, dPdx_;
    uint32_t row_ = kNone;
    const Shape* shape_ = nullptr;
    const Mesh* mesh_ = nullptr;
    bool instanced_ = false;
    mat3 linear_{1.0f}, normals_{1.0f};
    mat4 to_current_{1.0f}, from_current_{1.0f};
};

}  // namespace

void gather(Grid& grid) {
    Gather gatherer(grid, grid.shading->camera_from_accel_, grid.shading->eye_);
    for (size_t i = 0; i < grid.count(); ++i) gatherer.point(i);
    // Padding lanes are copies of the last point.
    size_t last = grid.count() - 1;
    for (float* column : grid.columns)
        if (column)
            for (size_t i = grid.count(); i < padded(grid.count()); ++i) column[i] = column[last];
    gatherer.constants();
}

}  // namespace kinora
