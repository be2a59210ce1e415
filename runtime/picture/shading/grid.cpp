// runtime/picture/shading/grid.cpp: from hits to the columns that kernels read.
#include "runtime/picture/shading/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "raytrace/hits.h"
#include "raytrace/points/points.h"
#include "runtime/picture/columns/kernels.h"
#include "runtime/picture/columns/sixteen_points.h"
#include "runtime/scene/description/affine_map.h"
#include "runtime/scene/kernels/point_source.h"
#include "runtime/scene/shaders/corner.h"
#include "runtime/scene/spaces.h"
#include "runtime/scene/transforms.h"

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

namespace {

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

// std::fill, sixteen at once.
void fill_row(float* from, float* to, float value) {
    float block[kColumnPoints];
    std::fill_n(block, kColumnPoints, value);
    for (; to - from >= ptrdiff_t(kColumnPoints); from += kColumnPoints)
        std::memcpy(from, block, sizeof(block));
    std::copy_n(block, to - from, from);
}

// Up to sixteen numbers of a block, nearly always all.
void copy_block(const float* block, size_t count, float* to) {
    if (count == kColumnPoints)
        std::memcpy(to, block, kColumnPoints * sizeof(float));
    else
        std::copy_n(block, count, to);
}

// A grid's columns filled run by run: hits of one row share all but their point on the triangle.
class HitSource : public PointSource {
  public:
    HitSource(Grid& grid, const mat3& rotation, vec3 eye)
        : grid_(grid),
          hits_(grid.hits),
          scene_(grid.frame.shapes),
          pose_(grid.pose),
          rotation_(rotation),
          eye_(eye) {
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
        uv_ |= column(kColdsdu) || column(kColdsdv) || column(kColdtdu) || column(kColdtdv);
        parameters_ = uv_ || partials_ || dNdu_ || dNdv_ || !grid.look->varying.empty();
        matrices_ = std::any_of(grid.columns.begin() + kColToCurrent,
                                grid.columns.begin() + kColVarying, [](float* c) { return c; });
    }

    // Surfaces with parameters of their own have other slopes of s and t.
    bool fills_constants() const override { return true; }
    void fill(const PointColumns& columns) override {
        fill_constants(columns);
        if (P_) positions();
        if (I_ && P_ && of_eye())
            share_positions();
        else if (I_ && !volume_)
            directions();
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
                for (size_t i = begin; i < end; i += kColumnPoints) sixteen_parameters(i, end);
            if (matrices_) matrices(begin, end);
            begin = end;
        }
        if (float* rng = column(kColRng)) random_numbers(rng);
    }

  private:
    float* column(size_t c) const { return grid_.columns[c]; }
    SixteenPoints sixteen(size_t first, size_t end) const {
        return {grid_.points, first, end, grid_.ascending};
    }

    Triple triple_rows(uint16_t first) {
        Triple t;
        if (!column(first) && !column(first + 1u) && !column(first + 2u)) return t;
        want_triple(grid_, first);
        for (size_t k = 0; k < 3; ++k) t.c[k] = column(first + k);
        return t;
    }

    void random_numbers(float* to) const {
        for (size_t first = 0; first < grid_.count(); first += kColumnPoints) {
            const SixteenPoints points = sixteen(first, grid_.count());
            uint32_t room[4][kColumnPoints], numbers[kColumnPoints];
            kernels_.random({points.at(hits_.pixel_x, room[0]), points.at(hits_.pixel_y, room[1]),
                             points.at(hits_.sample, room[2]), points.at(hits_.layer, room[3])},
                            hits_.depth, grid_.frame.seed, numbers);
            std::memcpy(to + first, numbers, points.count() * sizeof(float));
        }
    }

    // What all hits of one row share.
    void enter(uint32_t row) {
        surface_ = &scene_.surfaces[row];
        shape_ = &scene_.shapes[surface_->shape];
        stands_ = &pose_.shapes[surface_->shape];
        mesh_ = &scene_.meshes[shape_->mesh];
        if (shape_->kind == raytrace::GeometryKind::Instanced) {
            linear_ = rotation_ * mat3(dmat3(stands_->world));
            normals_ = rotation_ * normal_matrix(stands_->world, stands_->mirrored);
            unit_corners_ = !keeps_angles(normals_);
        } else {
            linear_ = normals_ = rotation_;
            unit_corners_ = false;
        }
    }

    Corner corner(size_t i) const {
        uint32_t hit = grid_.points[i];
        return {
            *surface_,    pose_,       *mesh_, mesh_->groups[surface_->group], hits_.primitive[hit],
            hits_.u[hit], hits_.v[hit]};
    }

    // Calls f(points, to): a block of the grid's points and the block's rows of `triple`.
    template <class F>
    void for_each_block(const Triple& triple, F&& f) const {
        for (size_t i = 0; i < grid_.count(); i += kColumnPoints) {
            float* const to[3] = {triple.c[0] + i, triple.c[1] + i, triple.c[2] + i};
            f(sixteen(i, grid_.count()), to);
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
    // Whether all rays began at the eye, where P and I are the same.
    bool of_eye() const {
        return hits_.rays && hits_.depth == 0 && !volume_ && !pose_.view.orthographic;
    }
    void share_positions() const {
        for (size_t k = 0; k < 3; ++k) grid_.columns[kColI + k] = P_.c[k];
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
        set_kinds(begin, end, 0);
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
            set_kinds(begin, end, raytrace::kOneNormal);
        } else if (unit_corners_) {
            for (size_t i = begin; i < end; ++i) stretched_normal(i);
            set_kinds(begin, end, 0);
        } else {
            for (size_t i = begin; i < end; i += kColumnPoints) sixteen_normals(i, end);
        }
    }
    void set_kinds(size_t begin, size_t end, uint32_t kind) const {
        if (!grid_.normals.empty())
            std::fill(grid_.normals.begin() + begin, grid_.normals.begin() + end, kind);
    }
    // A normal that vanishes gives way to the geometric one (docs/numerics.md#geometry).
    void sixteen_normals(size_t first, size_t end) const {
        const uint32_t* corners = mesh_->groups[surface_->group].normal_corners.data();
        const vec4* entries = stands_->shown_normals.data();
        const SixteenPoints points = sixteen(first, end);
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
        uint32_t kinds[kColumnPoints];
        uint32_t unsound = kernels_.mix_normals(&normals_[0][0], at, to, kinds);
        if (!grid_.normals.empty())
            std::copy_n(kinds, points.count(), grid_.normals.begin() + first);
        for (size_t k = 0; k < 3; ++k) copy_block(found[k], points.count(), N_.c[k] + first);
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

    // Numbers of a block to the rows from `first` on, where somebody asked for them.
    void put(size_t which, size_t first, size_t count, const float* numbers) const {
        if (float* row = column(which)) copy_block(numbers, count, row + first);
    }
    void put(const Triple& triple, size_t first, size_t count, const TripleRows& numbers) const {
        for (size_t k = 0; triple && k < 3; ++k)
            copy_block(numbers.at[k], count, triple.c[k] + first);
    }

    void sixteen_parameters(size_t first, size_t end) const {
        const SixteenPoints points = sixteen(first, end);
        const size_t count = points.count();
        Block block;
        for (size_t i = 0; i < kColumnPoints; ++i) {
            const uint32_t hit = points.hit(i);
            block.corner[i] = 3 * size_t(hits_.primitive[hit]);
            block.on.u[i] = hits_.u[hit];
            block.on.v[i] = hits_.v[hit];
        }
        TwoRows st, uv;
        find_parameters(block, st, uv);
        if (surface_->uv) texture_coordinates(block, first, count, st);
        put(kColU, first, count, uv.at[0]);
        put(kColV, first, count, uv.at[1]);
        put(kColS, first, count, st.at[0]);
        put(kColT, first, count, st.at[1]);
        varying(block, first, count);
        for (size_t i = 0; (dNdu_ || dNdv_) && i < count; ++i)
            normal_partials(first + i, corner(first + i), block.map(i));
        if (partials_) tangents(block, points, first);
    }

    // Sixteen points on triangles, and where the triangles' corners begin.
    struct Block {
        OnTriangles on;
        size_t corner[kColumnPoints];
        AffineMap map(size_t i) const {
            return {{{on.inv[0][0][i], on.inv[0][1][i]}, {on.inv[1][0][i], on.inv[1][1][i]}}};
        }
    };

    // Number `component` of an attribute at the corners.
    CornerNumbers of_attribute(const Block& block, const VertexAttribute& a,
                               uint32_t component) const {
        const float* values = values_of(a, pose_).data() + component;
        CornerNumbers x;
        for (size_t i = 0; i < kColumnPoints; ++i)
            for (size_t k = 0; k < 3; ++k)
                x.at[k][i] = values[size_t(a.corners[block.corner[i] + k]) * a.stride];
        return x;
    }
    // Of a surface with parameters of its own: s and t at the points, and how they change along u
    // and v.
    void texture_coordinates(const Block& block, size_t first, size_t count, TwoRows& st) const {
        const VertexAttribute* a = surface_->st;
        if (!a || a->stride < 2) return;
        constexpr size_t kAlong[2][2] = {{kColdsdu, kColdsdv}, {kColdtdu, kColdtdv}};
        for (uint32_t k = 0; k < 2; ++k) {
            TwoRows along;
            kernels_.mix(block.on, of_attribute(block, *a, k), st.at[k], along);
            put(kAlong[k][0], first, count, along.at[0]);
            put(kAlong[k][1], first, count, along.at[1]);
        }
    }
    void find_parameters(Block& block, TwoRows& st, TwoRows& uv) const {
        const VertexAttribute* a = surface_->uv ? surface_->uv : surface_->st;
        if (a && a->stride >= 2)
            return kernels_.find_parameters(block.on, of_attribute(block, *a, 0),
                                            of_attribute(block, *a, 1), st, uv);
        for (size_t i = 0; i < kColumnPoints; ++i) {
            st.at[0][i] = uv.at[0][i] = block.on.u[i];
            st.at[1][i] = uv.at[1][i] = block.on.v[i];
            block.on.inv[0][0][i] = block.on.inv[1][1][i] = 1;
            block.on.inv[0][1][i] = block.on.inv[1][0][i] = 0;
        }
    }

    void tangents(const Block& block, const SixteenPoints& points, size_t first) const {
        const uint32_t* corners = mesh_->groups[surface_->group].triangles.data();
        const vec4* places = stands_->shown_positions.data();
        CornerPlaces at;
        for (size_t i = 0; i < kColumnPoints; ++i)
            for (size_t k = 0; k < 3; ++k)
                std::memcpy(at.at[k][i], &places[corners[block.corner[i] + k]], sizeof(vec4));
        TripleRows dPdu, dPdv;
        kernels_.tangents(&linear_[0][0], block.on, at, dPdu, dPdv);
        put(dPdu_, first, points.count(), dPdu);
        put(dPdv_, first, points.count(), dPdv);
        put(dIdu_, first, points.count(), dPdu);
        put(dIdv_, first, points.count(), dPdv);
        if (!footprint_) return;
        TwoRows extents;
        kernels_.extents(dPdu, dPdv, turned(points, hits_.dPdx), turned(points, hits_.dPdy),
                         extents);
        put(kColDu, first, points.count(), extents.at[0]);
        put(kColDv, first, points.count(), extents.at[1]);
    }
    TripleRows turned(const SixteenPoints& points, const float* const columns[3]) const {
        float room[3][kColumnPoints];
        TripleRows out;
        float* const to[3] = {out.at[0], out.at[1], out.at[2]};
        kernels_.turn(&rotation_[0][0], points.at(columns, room), to);
        return out;
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

    void varying(const Block& block, size_t first, size_t count) const {
        for (size_t k = 0; k < grid_.look->varying.size(); ++k) {
            const VaryingParam& param = grid_.look->varying[k];
            if (param.column == kNoColumn) continue;  // no kernel reads it
            for (uint32_t j = 0; j < param.components; ++j) {
                const size_t which = param.column + j, n = param.components;
                if (!column(which) && !column(which + n) && !column(which + 2 * n)) continue;
                const CornerNumbers x = corner_numbers(block, param, surface_->varying[k], j);
                float value[kColumnPoints];
                TwoRows along;
                kernels_.mix(block.on, x, value, along);
                if (param.text) nearest(first, count, param, x, value);
                put(which, first, count, value);
                put(which + n, first, count, along.at[0]);
                put(which + 2 * n, first, count, along.at[1]);
            }
        }
    }
    CornerNumbers corner_numbers(const Block& block, const VaryingParam& param,
                                 const VertexAttribute* attribute, uint32_t component) const {
        if (attribute)
            return of_attribute(block, *attribute,
                                std::min(param.component + component, attribute->stride - 1));
        if (param.semantic != "Pref") return {};
        const uint32_t* corners = mesh_->groups[surface_->group].triangles.data();
        const int axis = int(component);
        const float anchor = float(mesh_->anchor[axis]);
        CornerNumbers x;
        for (size_t i = 0; i < kColumnPoints; ++i)
            for (size_t k = 0; k < 3; ++k)
                x.at[k][i] = mesh_->positions[corners[block.corner[i] + k]][axis] + anchor;
        return x;
    }
    void nearest(size_t first, size_t count, const VaryingParam& param,
                 const CornerNumbers& numbers, float* value) const {
        for (size_t i = 0; i < count; ++i) {
            const float x[3] = {numbers.at[0][i], numbers.at[1][i], numbers.at[2][i]};
            value[i] = between(corner(first + i), param, x);
        }
    }

    void matrices(size_t begin, size_t end) const {
        // A volume belongs to a node of its own, not to the surface behind it.
        dmat4 to = volume_
                       ? current_from_space(grid_.frame.nodes, pose_, "object", grid_.look->node)
                       : pose_.view.camera_from_world * pose_.nodes[shape_->node].world;
        mat4 to_current(to), from_current(glm::inverse(to));
        for (size_t r = 0; r < 3; ++r)
            for (size_t c = 0; c < 4; ++c) {
                auto fill_entry = [&](size_t first, const mat4& m) {
                    if (float* row = column(first + r * 4 + c))
                        fill_row(row + begin, row + end, m[int(c)][int(r)]);
                };
                fill_entry(kColToCurrent, to_current);
                fill_entry(kColFromCurrent, from_current);
            }
    }

    Grid& grid_;
    const raytrace::HitBatch& hits_;
    const SceneShapes& scene_;
    const Pose& pose_;
    const ColumnKernels& kernels_ = column_kernels();
    mat3 rotation_;
    vec3 eye_;
    Triple P_, I_, N_, Ng_, dPdu_, dPdv_, dIdu_, dIdv_, dNdu_, dNdv_;
    bool footprint_ = false, partials_ = false, uv_ = false, parameters_ = false;
    bool matrices_ = false, unit_corners_ = false;
    bool volume_ = grid_.look->kind == ShaderInstanceKind::Volume;
    const Surface* surface_ = nullptr;
    const Shape* shape_ = nullptr;
    const ShapePose* stands_ = nullptr;
    const Mesh* mesh_ = nullptr;
    mat3 linear_{1.0f}, normals_{1.0f};
};

}  // namespace

void gather(Grid& grid) {
    const auto wanted = std::count_if(grid.columns.begin(), grid.columns.end(),
                                      [](const float* column) { return column != nullptr; });
    grid.memory.counters.columns += grid.count() * uint64_t(wanted);
    HitSource source(grid, grid.frame.camera_from_accel, grid.frame.eye);
    fill_columns(source, {grid.count(), grid.columns});
}

}  // namespace kinora
