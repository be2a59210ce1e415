// runtime/shading/grid.cpp: from hits to the columns that kernels read.
#include "runtime/shading/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "raytrace/hits.h"
#include "runtime/columns/kernels.h"
#include "runtime/description/affine_map.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/spaces.h"
#include "runtime/shading/kernels/point_source.h"

namespace kinora {

void want_columns(Grid& grid, std::span<const uint16_t> wanted) {
    for (uint16_t column : wanted)
        if (!grid.columns[column])
            grid.columns[column] =
                grid.memory.arena.allocate_span<float>(padded(grid.count())).data();
}

void want_triple(Grid& grid, uint16_t first) {
    uint16_t wanted[] = {first, uint16_t(first + 1), uint16_t(first + 2)};
    want_columns(grid, wanted);
}

mat3 normal_matrix(const dmat4& m, bool mirrored) {
    dmat3 l(m);
    dmat3 cofactor(glm::cross(l[1], l[2]), glm::cross(l[2], l[0]), glm::cross(l[0], l[1]));
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(cofactor[c][r]));
    if (largest > 0 && std::isfinite(largest)) cofactor /= largest;
    return mat3(mirrored ? -cofactor : cofactor);
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
    if (!solve(p.map, du1, dv1, du2, dv2)) return p;
    p.u = p.s;
    p.v = p.t;
    return p;
}

// A number of a varying parameter at the three corners.
void corner_values(const Corner& c, const VaryingParam& param, const VertexAttribute* attribute,
                   uint32_t component, float x[3]) {
    for (int corner = 0; corner < 3; ++corner) {
        x[corner] = 0;
        if (attribute) {
            uint32_t from = std::min(param.component + component, attribute->stride - 1);
            x[corner] = c.attribute(*attribute, corner)[from];
        } else if (param.semantic == "Pref") {
            x[corner] = c.mesh.positions[c.position(corner)][int(component)] +
                        float(c.mesh.anchor[int(component)]);
        }
    }
}

// Between the corners; a text is the nearest corner's, bit for bit.
float between(const Corner& c, const VaryingParam& param, const float x[3]) {
    if (!param.text) return x[0] + c.u * (x[1] - x[0]) + c.v * (x[2] - x[0]);
    float w = 1 - c.u - c.v;
    return w >= c.u && w >= c.v ? x[0] : c.u >= c.v ? x[1] : x[2];
}

// The footprint in u, v of displacements on the surface: least squares on dPdu, dPdv. In double:
// the fourth power of a length is no float in scenes of kilometres or micrometres.
class Footprint {
  public:
    Footprint(dvec3 dPdu, dvec3 dPdv)
        : dPdu_(dPdu),
          dPdv_(dPdv),
          a_(glm::dot(dPdu, dPdu)),
          b_(glm::dot(dPdu, dPdv)),
          c_(glm::dot(dPdv, dPdv)) {
        double det = a_ * c_ - b_ * b_;
        inverse_ = det > 0 ? 1 / det : 0;
    }
    vec2 of(dvec3 dP) const {
        double x = glm::dot(dPdu_, dP), y = glm::dot(dPdv_, dP);
        return vec2(float((c_ * x - b_ * y) * inverse_), float((a_ * y - b_ * x) * inverse_));
    }

  private:
    dvec3 dPdu_, dPdv_;
    double a_, b_, c_, inverse_;
};

// Whether it keeps angles, so that mixed normals need not be made unit first.
bool keeps_angles(const mat3& m) {
    float x = glm::dot(m[0], m[0]), y = glm::dot(m[1], m[1]), z = glm::dot(m[2], m[2]);
    float least = 1e-5f * std::max({x, y, z});
    return std::abs(x - y) <= least && std::abs(x - z) <= least &&
           std::abs(glm::dot(m[0], m[1])) <= least && std::abs(glm::dot(m[1], m[2])) <= least &&
           std::abs(glm::dot(m[2], m[0])) <= least;
}

vec3 unit_or_zero(vec3 v) {
    float square = glm::dot(v, v);
    return square > 0 && square < std::numeric_limits<float>::infinity() ? v / std::sqrt(square)
                                                                         : vec3(0);
}

// Rows of one triple; a triple that is wanted in part has all three rows.
struct Triple {
    float* c[3] = {};
    explicit operator bool() const { return c[0]; }
    void set(size_t i, vec3 value) const {
        c[0][i] = value.x;
        c[1][i] = value.y;
        c[2][i] = value.z;
    }
};

// Up to sixteen points of a grid, whose hits often lie one behind the other.
class SixteenPoints {
  public:
    SixteenPoints(std::span<const uint32_t> points, size_t first, size_t end)
        : hit_(points.data() + first),
          count_(std::min(kColumnPoints, end - first)),
          dense_(count_ == kColumnPoints &&
                 hit_[kColumnPoints - 1] - hit_[0] == kColumnPoints - 1 &&
                 std::is_sorted(hit_, hit_ + kColumnPoints)) {}

    size_t count() const { return count_; }
    uint32_t hit(size_t i) const { return hit_[i < count_ ? i : 0]; }
    // A column of hits at these points, in `room` where it is not there in one piece.
    const float* at(const float* column, float (&room)[kColumnPoints]) const {
        if (dense_) return column + hit_[0];
        for (size_t i = 0; i < kColumnPoints; ++i) room[i] = column[hit(i)];
        return room;
    }
    TripleColumns at(const float* const columns[3], float (&room)[3][kColumnPoints]) const {
        return {{at(columns[0], room[0]), at(columns[1], room[1]), at(columns[2], room[2])}};
    }

  private:
    const uint32_t* hit_;
    size_t count_;
    bool dense_;
};

// A grid's columns filled run by run: hits of one row share all but their point on the triangle.
class HitSource : public PointSource {
  public:
    HitSource(Grid& grid, const mat3& rotation, vec3 eye)
        : grid_(grid), hits_(grid.hits), scene_(grid.scene), rotation_(rotation), eye_(eye) {
        P_ = triple_rows(kColP);
        I_ = triple_rows(kColI);
        N_ = triple_rows(kColN);
        Ng_ = triple_rows(kColNg);
        dPdu_ = triple_rows(kColdPdu);
        dPdv_ = triple_rows(kColdPdv);
        dIdu_ = triple_rows(kColdIdu);
        dIdv_ = triple_rows(kColdIdv);
        dNdu_ = triple_rows(kColdNdu);
        dNdv_ = triple_rows(kColdNdv);
        footprint_ = column(kColDu) || column(kColDv);
        partials_ = dPdu_ || dPdv_ || dIdu_ || dIdv_ || footprint_;
        uv_ = column(kColU) || column(kColV) || column(kColS) || column(kColT);
        parameters_ = uv_ || partials_ || dNdu_ || dNdv_ || !grid.look->varying.empty();
        matrices_ = std::any_of(grid.columns.begin() + kColToCurrent,
                                grid.columns.begin() + kColVarying, [](float* c) { return c; });
    }

    void fill(const PointColumns&) override {
        if (P_) positions();
        if (I_ && !volume_) directions();
        if (Ng_) geometric_normals();
        for (size_t begin = 0; begin < grid_.count();) {
            uint32_t row = hits_.instance[grid_.points[begin]];
            size_t end = begin + 1;
            while (end < grid_.count() && hits_.instance[grid_.points[end]] == row) ++end;
            if (row == kNone) {
                open_ends(begin, end);
                begin = end;
                continue;
            }
            enter(row);
            if (I_ && volume_) segments(begin, end);
            if (N_) normals(begin, end);
            if (parameters_)
                for (size_t i = begin; i < end; ++i) parameters_at(i);
            if (matrices_) matrices(begin, end);
            begin = end;
        }
        if (float* rng = column(kColRng))
            for (size_t i = 0; i < grid_.count(); ++i)
                rng[i] = jit::float_of(int32_t(random_of(hits_, grid_.points[i])));
    }

  private:
    float* column(size_t c) const { return grid_.columns[c]; }

    Triple triple_rows(uint16_t first) {
        Triple t;
        if (!column(first) && !column(first + 1u) && !column(first + 2u)) return t;
        want_triple(grid_, first);
        for (size_t k = 0; k < 3; ++k) t.c[k] = column(first + k);
        return t;
    }

    // What all hits of one row share.
    void enter(uint32_t row) {
        surface_ = &scene_.surfaces[row];
        shape_ = &scene_.shapes[surface_->shape];
        mesh_ = &scene_.meshes[shape_->mesh];
        if (shape_->kind == raytrace::GeometryKind::Instanced) {
            linear_ = rotation_ * mat3(dmat3(shape_->world));
            normals_ = rotation_ * normal_matrix(shape_->world, shape_->mirrored);
            unit_corners_ = !keeps_angles(normals_);
        } else {
            linear_ = normals_ = rotation_;
            unit_corners_ = false;
        }
    }

    Corner corner(size_t i) const {
        uint32_t hit = grid_.points[i];
        return {
            *surface_,    *shape_,     *mesh_, mesh_->groups[surface_->group], hits_.primitive[hit],
            hits_.u[hit], hits_.v[hit]};
    }

    // Calls f(points, to): a block of the grid's points and the block's rows of `triple`.
    template <class F>
    void for_each_block(const Triple& triple, F&& f) const {
        for (size_t i = 0; i < grid_.count(); i += kColumnPoints) {
            float* const to[3] = {triple.c[0] + i, triple.c[1] + i, triple.c[2] + i};
            f(SixteenPoints(grid_.points, i, grid_.count()), to);
        }
    }
    void positions() const {
        for_each_block(P_, [&](const SixteenPoints& points, float* const to[3]) {
            float room[3][kColumnPoints];
            kernels_.turn_from(&rotation_[0][0], points.at(hits_.P, room), &eye_.x, to);
        });
    }
    void directions() const {
        for_each_block(I_, [&](const SixteenPoints& points, float* const to[3]) {
            float room[3][kColumnPoints], more[3][kColumnPoints];
            kernels_.turn_between(&rotation_[0][0], points.at(hits_.P, room),
                                  points.at(hits_.org, more), to);
        });
    }
    // Volumes see the way through themselves: from the last surface (or the eye) to P.
    void segments(size_t begin, size_t end) const {
        for (size_t i = begin; i < end; ++i) {
            uint32_t hit = grid_.points[i];
            I_.set(i, rotation_ * segment(hits_, hit));
        }
    }
    // Where a ray leaves the scene there is no surface: N and Ng look back, all else is 0.
    void open_ends(size_t begin, size_t end) {
        for (float* rows : grid_.columns)
            if (rows) std::fill(rows + begin, rows + end, 0.0f);
        for (size_t i = begin; i < end; ++i) {
            if (P_) P_.set(i, rotation_ * (triple(hits_.P, grid_.points[i]) - eye_));
            vec3 back = rotation_ * -glm::normalize(triple(hits_.dir, grid_.points[i]));
            if (N_) N_.set(i, back);
            if (Ng_) Ng_.set(i, back);
        }
        if (I_) segments(begin, end);
        if (matrices_) matrices(begin, end);
    }
    void geometric_normals() const {
        for_each_block(Ng_, [&](const SixteenPoints& points, float* const to[3]) {
            float room[3][kColumnPoints];
            kernels_.turn(&rotation_[0][0], points.at(hits_.Ng, room), to);
        });
    }
    vec3 geometric_normal(size_t i) const { return rotation_ * triple(hits_.Ng, grid_.points[i]); }
    // Unit where the mixture would not come out as between the normals of a still, baked mesh.
    vec3 current_normal(vec3 entry) const {
        vec3 n = normals_ * entry;
        return unit_corners_ ? unit_or_zero(n) : n;
    }
    void normals(size_t begin, size_t end) const {
        if (mesh_->groups[surface_->group].flat()) {
            for (size_t i = begin; i < end; ++i) N_.set(i, geometric_normal(i));
            return;
        }
        if (unit_corners_)
            for (size_t i = begin; i < end; ++i) stretched_normal(i);
        else
            for (size_t i = begin; i < end; i += kColumnPoints) sixteen_normals(i, end);
    }
    // A normal that vanishes gives way to the geometric one (docs/numerics.md#geometry).
    void sixteen_normals(size_t first, size_t end) const {
        const uint32_t* corners = mesh_->groups[surface_->group].normal_corners.data();
        const vec4* entries = shape_->rest_normals.data();
        const SixteenPoints points(grid_.points, first, end);
        CornerNormals at;
        for (size_t i = 0; i < kColumnPoints; ++i) {
            const uint32_t hit = points.hit(i);
            const uint32_t* c = corners + 3 * size_t(hits_.primitive[hit]);
            for (int k = 0; k < 3; ++k) std::memcpy(at.corner[k][i], &entries[c[k]], sizeof(vec4));
            at.u[i] = hits_.u[hit];
            at.v[i] = hits_.v[hit];
        }
        float found[3][kColumnPoints];
        float* const to[3] = {found[0], found[1], found[2]};
        uint32_t unsound = kernels_.mix_normals(&normals_[0][0], at, to);
        for (size_t k = 0; k < 3; ++k) std::copy_n(found[k], points.count(), N_.c[k] + first);
        for (unsound &= (1u << points.count()) - 1; unsound; unsound &= unsound - 1) {
            const size_t i = first + size_t(std::countr_zero(unsound));
            N_.set(i, geometric_normal(i));
        }
    }
    void stretched_normal(size_t i) const {
        const Corner c = corner(i);
        const vec3 N = (1 - c.u - c.v) * current_normal(c.normal(0)) +
                       c.u * current_normal(c.normal(1)) + c.v * current_normal(c.normal(2));
        const float square = glm::dot(N, N);
        const bool sound = square > 0 && square < std::numeric_limits<float>::infinity();
        N_.set(i, sound ? N / std::sqrt(square) : geometric_normal(i));
    }

    void parameters_at(size_t i) const {
        Corner c = corner(i);
        Parameters p = parameters(c);
        auto put = [&](size_t which, float value) {
            if (float* row = column(which)) row[i] = value;
        };
        put(kColU, p.u);
        put(kColV, p.v);
        put(kColS, p.s);
        put(kColT, p.t);
        varying(i, c, p.map);
        if (dNdu_ || dNdv_) normal_partials(i, c, p.map);
        if (!partials_) return;
        std::span<const vec4> x = shape_->rest_positions;
        vec3 p0(x[c.position(0)]), p1(x[c.position(1)]), p2(x[c.position(2)]);
        vec3 e1 = linear_ * (p1 - p0), e2 = linear_ * (p2 - p0);
        vec3 dPdu = p.map.along_u(e1, e2), dPdv = p.map.along_v(e1, e2);
        if (dPdu_) dPdu_.set(i, dPdu);
        if (dPdv_) dPdv_.set(i, dPdv);
        if (dIdu_) dIdu_.set(i, dPdu);
        if (dIdv_) dIdv_.set(i, dPdv);
        if (!footprint_) return;
        uint32_t hit = grid_.points[i];
        Footprint footprint{dvec3(dPdu), dvec3(dPdv)};
        vec2 along_x = footprint.of(dvec3(rotation_ * triple(hits_.dPdx, hit)));
        vec2 along_y = footprint.of(dvec3(rotation_ * triple(hits_.dPdy, hit)));
        put(kColDu, std::max(std::abs(along_x.x), std::abs(along_y.x)));
        put(kColDv, std::max(std::abs(along_x.y), std::abs(along_y.y)));
    }

    // Of the unit normal n = m / |m|: n_u = (m_u - n (n . m_u)) / |m|. On flat faces it is 0.
    void normal_partials(size_t i, const Corner& c, const AffineMap& map) const {
        if (c.group.flat()) {
            if (dNdu_) dNdu_.set(i, vec3(0));
            if (dNdv_) dNdv_.set(i, vec3(0));
            return;
        }
        vec3 n0 = current_normal(c.normal(0)), n1 = current_normal(c.normal(1)),
             n2 = current_normal(c.normal(2));
        vec3 m = (1 - c.u - c.v) * n0 + c.u * n1 + c.v * n2;
        float length = glm::length(m);
        vec3 n = length > 0 ? m / length : vec3(0);
        auto partial = [&](vec3 d) {
            return length > 0 ? (d - n * glm::dot(n, d)) / length : vec3(0);
        };
        if (dNdu_) dNdu_.set(i, partial(map.along_u(n1 - n0, n2 - n0)));
        if (dNdv_) dNdv_.set(i, partial(map.along_v(n1 - n0, n2 - n0)));
    }

    void varying(size_t i, const Corner& c, const AffineMap& map) const {
        for (size_t k = 0; k < grid_.look->varying.size(); ++k) {
            const VaryingParam& param = grid_.look->varying[k];
            if (param.column == kNoColumn) continue;  // no kernel reads it
            for (uint32_t j = 0; j < param.components; ++j) {
                float x[3];
                corner_values(c, param, surface_->varying[k], j, x);
                float d1 = x[1] - x[0], d2 = x[2] - x[0];
                auto put = [&](uint32_t which, float value) {
                    if (float* row = column(param.column + which)) row[i] = value;
                };
                put(j, between(c, param, x));
                put(param.components + j, map.along_u(d1, d2));
                put(2 * param.components + j, map.along_v(d1, d2));
            }
        }
    }

    void matrices(size_t begin, size_t end) const {
        // A volume belongs to a node of its own, not to the surface behind it.
        dmat4 to = volume_ ? current_from_space(scene_, "object", grid_.look->node)
                           : scene_.view.camera_from_world * scene_.nodes[shape_->node].world;
        mat4 to_current(to), from_current(glm::inverse(to));
        for (size_t r = 0; r < 3; ++r)
            for (size_t c = 0; c < 4; ++c) {
                auto fill_entry = [&](size_t first, const mat4& m) {
                    if (float* row = column(first + r * 4 + c))
                        std::fill(row + begin, row + end, m[int(c)][int(r)]);
                };
                fill_entry(kColToCurrent, to_current);
                fill_entry(kColFromCurrent, from_current);
            }
    }

    Grid& grid_;
    const raytrace::HitBatch& hits_;
    const Scene& scene_;
    const ColumnKernels& kernels_ = column_kernels();
    mat3 rotation_;
    vec3 eye_;
    Triple P_, I_, N_, Ng_, dPdu_, dPdv_, dIdu_, dIdv_, dNdu_, dNdv_;
    bool footprint_ = false, partials_ = false, uv_ = false, parameters_ = false;
    bool matrices_ = false, unit_corners_ = false;
    bool volume_ = grid_.look->kind == ShaderInstanceKind::Volume;
    const Surface* surface_ = nullptr;
    const Shape* shape_ = nullptr;
    const Mesh* mesh_ = nullptr;
    mat3 linear_{1.0f}, normals_{1.0f};
};

}  // namespace

void gather(Grid& grid) {
    HitSource source(grid, grid.frame.camera_from_accel, grid.frame.eye);
    fill_columns(source, {grid.count(), grid.columns});
}

float varying_at(const Scene& scene, const raytrace::HitBatch& hits, uint32_t hit, size_t which,
                 uint32_t component) {
    const Surface& surface = scene.surfaces[hits.instance[hit]];
    const Shape& shape = scene.shapes[surface.shape];
    const Mesh& mesh = scene.meshes[shape.mesh];
    Corner c{surface,     shape,      mesh, mesh.groups[surface.group], hits.primitive[hit],
             hits.u[hit], hits.v[hit]};
    const VaryingParam& param = scene.shader_instances[surface.look]->varying[which];
    float x[3];
    corner_values(c, param, surface.varying[which], component, x);
    return between(c, param, x);
}

}  // namespace kinora
