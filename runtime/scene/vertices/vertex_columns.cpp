// runtime/scene/vertices/vertex_columns.cpp: kernel inputs at the wedges of a mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "raytrace/sampling.h"
#include "runtime/scene/description/affine_map.h"
#include "runtime/scene/kernels/point_source.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/vertices/vertex_columns_p.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {

namespace {

// The cofactor takes normals along whatever the scale (docs/numerics.md#geometry), a mirror's sign
// taken out.
mat3 normal_matrix(const dmat3& l) {
    dmat3 cofactor(glm::cross(l[1], l[2]), glm::cross(l[2], l[0]), glm::cross(l[0], l[1]));
    return mat3(glm::determinant(l) < 0 ? -cofactor : cofactor);
}

}  // namespace

VertexSpace::VertexSpace(const SceneExtent& scene, const Pose& pose, uint32_t node,
                         const dmat4& object_from_mesh, dvec3 anchor) {
    dmat4 from_anchor(1.0);
    from_anchor[3] = dvec4(anchor, 1.0);
    object = object_from_mesh * from_anchor;
    dmat3 l(object), back = glm::inverse(l);
    linear = mat3(l);
    normals = normal_matrix(l);
    mesh_linear = mat3(back);
    mesh_normals = normal_matrix(back);
    const raytrace::Camera& view = pose.view;
    dmat4 object_from_world = glm::inverse(pose.nodes[node].world);
    eye_object = dvec3(object_from_world * dvec4(view.eye + scene.origin, 1.0));
    orthographic = view.orthographic;
    dvec3 forward = dvec3(view.world_from_camera[2]);
    axis = vec3(dmat3(object_from_world) * forward);
    depth = vec3(glm::transpose(dmat3(pose.nodes[node].world)) * forward);
    double scale =
        orthographic ? std::cbrt(std::abs(glm::determinant(dmat3(object_from_world)))) : 1;
    pixel = view.width ? float(scale * 2 * view.half_width / view.width) : 0.0f;
}

namespace {

class Wedges : public PointSource {
  public:
    Wedges(const ShaderInstance& look, const VertexSource& source, const Pose& pose,
           const VertexSpace& space, size_t begin, size_t end, Arena& arena)
        : look_(look),
          source_(source),
          pose_(pose),
          space_(space),
          begin_(begin),
          count_(end - begin),
          arena_(arena),
          columns_(arena.allocate_span<float*>(look.column_count)) {
        std::fill(columns_.begin(), columns_.end(), nullptr);
        for (uint16_t c : look.full.columns) take(c);
        for (uint16_t first : kTriples)
            if (columns_[first] || columns_[first + 1u] || columns_[first + 2u])
                for (uint16_t k = 0; k < 3; ++k) take(uint16_t(first + k));
        for (uint16_t k = 0; k < 3; ++k) take(uint16_t(kColP + k));
    }

    void fill(const PointColumns&) override {
        bool tangents = columns_[kColdPdu] || columns_[kColdPdv] || columns_[kColdIdu] ||
                        columns_[kColdIdv] || columns_[kColDu] || columns_[kColDv];
        bool partials =
            tangents || columns_[kColdNdu] || columns_[kColdNdv] ||
            std::any_of(columns_.begin() + kColVarying, columns_.end(), [](float* c) { return c; });
        for (size_t i = 0; i < count_; ++i) {
            size_t w = begin_ + i;
            vec3 P = position(w), N = normal(w);
            set(kColP, i, P);
            set(kColN, i, N);
            set(kColI, i, space_.seen_along(P - vec3(space_.eye_object)));
            if (columns_[kColNg]) set(kColNg, i, geometric_normal(w, N));
            coordinates(i, w);
            if (partials) derivatives(i, w, P, N, tangents);
            if (float* rng = columns_[kColRng])
                rng[i] = jit::float_of(
                    int32_t(raytrace::hash(source_.welds[source_.group.position[w]], 0x76657274)));
        }
        spaces();
    }
    std::span<float*> rows() const { return columns_; }

  private:
    static constexpr uint16_t kTriples[] = {kColP, kColdPdu, kColdPdv, kColN,    kColNg,
                                            kColI, kColdNdu, kColdNdv, kColdIdu, kColdIdv};

    void take(uint16_t c) {
        if (!columns_[c]) columns_[c] = arena_.allocate_span<float>(jit::padded(count_)).data();
    }
    void set(size_t first, size_t i, vec3 v) {
        if (!columns_[first]) return;
        for (size_t k = 0; k < 3; ++k) columns_[first + k][i] = v[int(k)];
    }
    void put(size_t column, size_t i, float value) {
        if (columns_[column]) columns_[column][i] = value;
    }

    vec3 position(size_t w) const {
        const vec4& p = source_.positions[source_.group.position[w]];
        return vec3(space_.object * dvec4(p.x, p.y, p.z, 1.0));
    }
    vec3 normal(size_t w) const {
        if (source_.group.normal.empty()) return geometric_normal(w, vec3(0));
        vec3 n = space_.normals * vec3(source_.normals[source_.group.normal[w]]);
        float square = glm::dot(n, n);
        return square > 0 ? n / std::sqrt(square) : geometric_normal(w, vec3(0));
    }
    // The same; neighbors want the normals of the same wedges.
    vec3 known_normal(uint32_t w) {
        KnownNormal& known = known_[w % known_.size()];
        if (known.wedge != w) known = {w, normal(w)};
        return known.normal;
    }
    vec3 geometric_normal(size_t w, vec3 otherwise) const {
        vec3 sum(0.0f);
        for (uint32_t corner : source_.corners.of(w)) sum += source_.faces[corner / 3];
        sum = space_.normals * sum;
        float square = glm::dot(sum, sum);
        return square > 0 ? sum / std::sqrt(square) : otherwise;
    }

    const float* value(const VertexAttribute& a, size_t w) const {
        return &values_of(a, pose_)[w * a.stride];  // a diced mesh has one entry a wedge
    }
    void coordinates(size_t i, size_t w) {
        const float* st = value(*source_.st, w);
        put(kColU, i, st[0]);
        put(kColV, i, st[1]);
        put(kColS, i, st[0]);
        put(kColT, i, st[1]);
    }

    // Calls f(map, w0, w1, w2) for the triangles around a wedge; those without area in u, v only
    // where there is no other.
    template <class F>
    int for_each_triangle(size_t w, F&& f) const {
        int count = 0;
        for (bool degenerate : {false, true}) {
            for (uint32_t corner : source_.corners.of(w)) {
                const uint32_t* c = &source_.group.corners[corner - corner % 3];
                const float *a = value(*source_.st, c[0]), *b = value(*source_.st, c[1]);
                const float* d = value(*source_.st, c[2]);
                AffineMap map;
                bool sound = solve(map, b[0] - a[0], b[1] - a[1], d[0] - a[0], d[1] - a[1]);
                if (sound == degenerate) continue;
                f(map, c[0], c[1], c[2]);
                ++count;
            }
            if (count) break;
        }
        return std::max(count, 1);
    }

    void derivatives(size_t i, size_t w, vec3 P, vec3 N, bool tangents) {
        vec3 dPdu(0.0f), dPdv(0.0f), dNdu(0.0f), dNdv(0.0f);
        bool normals = columns_[kColdNdu] || columns_[kColdNdv];
        int count =
            for_each_triangle(w, [&](const AffineMap& map, uint32_t a, uint32_t b, uint32_t c) {
                if (tangents) {
                    vec3 e1 = edge(a, b), e2 = edge(a, c);
                    dPdu += map.along_u(e1, e2);
                    dPdv += map.along_v(e1, e2);
                }
                if (normals) {
                    vec3 n0 = known_normal(a), d1 = known_normal(b) - n0, d2 = known_normal(c) - n0;
                    dNdu += map.along_u(d1, d2);
                    dNdv += map.along_v(d1, d2);
                }
            });
        auto in_plane = [&](vec3 v) { return v - N * glm::dot(N, v); };
        dPdu = in_plane(dPdu / float(count));
        dPdv = in_plane(dPdv / float(count));
        set(kColdPdu, i, dPdu);
        set(kColdPdv, i, dPdv);
        set(kColdIdu, i, space_.seen_along(dPdu));
        set(kColdIdv, i, space_.seen_along(dPdv));
        set(kColdNdu, i, in_plane(dNdu / float(count)));
        set(kColdNdv, i, in_plane(dNdv / float(count)));
        float width = space_.pixel;
        if (!space_.orthographic) width *= glm::length(P - vec3(space_.eye_object));
        put(kColDu, i, footprint(width, dPdu));
        put(kColDv, i, footprint(width, dPdv));
        varying(i, w);
    }
    static float footprint(float width, vec3 partial) {
        float length = glm::length(partial);
        return length > 0 ? width / length : 0.0f;
    }
    vec3 edge(uint32_t a, uint32_t b) const {
        const std::vector<uint32_t>& p = source_.group.position;
        return space_.linear * (vec3(source_.positions[p[b]]) - vec3(source_.positions[p[a]]));
    }

    void varying(size_t i, size_t w) {
        for (size_t k = 0; k < look_.varying.size(); ++k) {
            const VaryingParam& param = look_.varying[k];
            const VertexAttribute* attribute = source_.varying[k];
            for (uint32_t j = 0; j < param.components; ++j) {
                auto at = [&](size_t wedge) -> float {
                    if (!attribute) return 0.0f;
                    return value(*attribute,
                                 wedge)[std::min(param.component + j, attribute->stride - 1)];
                };
                float du = 0, dv = 0;
                int count = for_each_triangle(
                    w, [&](const AffineMap& map, uint32_t a, uint32_t b, uint32_t c) {
                        float d1 = at(b) - at(a), d2 = at(c) - at(a);
                        du += map.along_u(d1, d2);
                        dv += map.along_v(d1, d2);
                    });
                put(param.column + j, i, at(w));
                put(param.column + param.components + j, i, du / float(count));
                put(param.column + 2 * param.components + j, i, dv / float(count));
            }
        }
    }

    void spaces() {
        for (size_t first : {size_t(kColToCurrent), size_t(kColFromCurrent)})  // the identity
            for (size_t k = 0; k < 12; ++k)
                if (float* row = columns_[first + k])
                    std::fill_n(row, count_, k % 5 == 0 ? 1.0f : 0.0f);
    }

    const ShaderInstance& look_;
    const VertexSource& source_;
    const Pose& pose_;
    const VertexSpace& space_;
    size_t begin_, count_;
    Arena& arena_;
    std::span<float*> columns_;
    struct KnownNormal {
        uint32_t wedge = kNone;
        vec3 normal{0.0f};
    };
    std::array<KnownNormal, 256> known_;
};

}  // namespace

std::span<float*> fill_vertex_columns(const ShaderInstance& look, const VertexSource& source,
                                      const Pose& pose, const VertexSpace& space, size_t begin,
                                      size_t end, Arena& arena) {
    Wedges wedges(look, source, pose, space, begin, end, arena);
    fill_columns(wedges, {end - begin, wedges.rows()});
    return wedges.rows();
}

}  // namespace kinora
