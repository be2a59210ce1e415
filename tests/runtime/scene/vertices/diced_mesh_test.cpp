// tests/runtime/scene/vertices/diced_mesh_test.cpp: meshes split in parts by several threads,
// against a definition that splits one triangle after another and numbers what it meets in a map.
#include "runtime/scene/vertices/diced_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "runtime/base/parallel.h"
#include "runtime/scene/build/shapes/mesh.h"
#include "runtime/scene/vertices/weld.h"

namespace kinora {
namespace {

// A bent grid of n x n squares with normals and texture coordinates, in two groups; one square of
// it is much larger than the rest. Texture coordinates have a seam in the middle.
MeshDefinition bent_grid(int n) {
    MeshDefinition mesh;
    auto coordinate = [&](int k) { return k == n ? 3.0 : double(k) / n; };
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            mesh.positions.push_back({coordinate(x), coordinate(y), 0.2 * std::sin(3.0 * x + y)});
    for (int g = 0; g < 2; ++g) {
        PrimitiveGroup& group = mesh.groups.emplace_back();
        VertexAttribute normals, st;
        normals.semantic = "NORMAL";
        st.semantic = "TEXCOORD";
        normals.stride = 3;
        st.stride = 2;
        for (const dvec3& p : mesh.positions) {
            vec3 normal = glm::normalize(vec3(0.3 * p.x, -p.y, 2));
            for (int k = 0; k < 3; ++k) normals.values.push_back(normal[k]);
        }
        for (int seam = 0; seam < 2; ++seam)
            for (const dvec3& p : mesh.positions) {
                st.values.push_back(float(p.x) + float(seam));
                st.values.push_back(float(p.y));
            }
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                if ((x + y) % 3 / 2 != g) continue;
                const uint32_t a = uint32_t(y * (n + 1) + x), c = a + uint32_t(n + 1);
                for (uint32_t corner : {a, a + 1, c + 1, a, c + 1, c}) {
                    group.triangles.push_back(corner);
                    normals.corners.push_back(corner);
                    st.corners.push_back(corner +
                                         (2 * x < n ? 0 : uint32_t(mesh.positions.size())));
                }
            }
        group.attributes = {normals, st};
    }
    return mesh;
}

dvec3 place(const Mesh& base, const uint32_t corners[3], DicePoint at) {
    dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k)
        sum += double(at.weight(k)) / kDiceOne * dvec3(base.positions[corners[k]]);
    return sum;
}

// The definition: edges are halved while they are too long; vertices are numbered as triangles
// first meet them. A vertex is known by the corners with weight and by these weights.
class Definition {
  public:
    using Weights = std::map<uint32_t, uint32_t>;  // of entries
    using Rule = std::function<bool(const uint32_t*, DicePoint, DicePoint)>;

    Definition(const Mesh& base, Rule longer) : base_(base), longer_(std::move(longer)) {
        for (uint32_t p = 0; p < base.positions.size(); ++p) positions_[{{p, kDiceOne}}] = p;
        for (size_t g = 0; g < base.groups.size(); ++g) {
            wedges_.clear();
            wedge_positions.emplace_back();
            corners.emplace_back();
            for (size_t t = 0; t < base.groups[g].triangles.size() / 3; ++t) {
                group_ = &base.groups[g];
                triangle_ = t;
                split({DicePoint{0, 0}, DicePoint{kDiceOne, 0}, DicePoint{0, kDiceOne}});
            }
        }
    }

    std::vector<std::vector<uint32_t>> corners;          // by group: wedges
    std::vector<std::vector<uint32_t>> wedge_positions;  // by group
    size_t positions() const { return positions_.size(); }

  private:
    using Corners = std::array<DicePoint, 3>;

    bool too_long(DicePoint a, DicePoint b) const {
        bool has_middle = (a.i + b.i) % 2 == 0 && (a.j + b.j) % 2 == 0;
        return has_middle && longer_(&group_->triangles[3 * triangle_], a, b);
    }

    void split(Corners p) {
        auto middle = [](DicePoint a, DicePoint b) {
            return DicePoint{(a.i + b.i) / 2, (a.j + b.j) / 2};
        };
        auto long_edges = [&] {
            return std::array<bool, 3>{too_long(p[0], p[1]), too_long(p[1], p[2]),
                                       too_long(p[2], p[0])};
        };
        std::array<bool, 3> is_long = long_edges();
        const int count = is_long[0] + is_long[1] + is_long[2];
        if (count == 0) return emit(p);
        // Turned until edge 0 alone is long, or edge 2 alone is short.
        while (count < 3 && !(count == 1 ? is_long[0] : !is_long[2])) {
            p = {p[1], p[2], p[0]};
            is_long = long_edges();
        }
        const DicePoint m = middle(p[0], p[1]), n = middle(p[1], p[2]), o = middle(p[2], p[0]);
        if (count == 1) {
            split({p[0], m, p[2]});
            split({m, p[1], p[2]});
        } else if (count == 2) {
            split({m, p[1], n});
            if (square(p[0], n) <= square(m, p[2])) {
                split({p[0], m, n});
                split({p[0], n, p[2]});
            } else {
                split({p[0], m, p[2]});
                split({m, n, p[2]});
            }
        } else {
            for (const Corners& part :
                 {Corners{p[0], m, o}, Corners{m, p[1], n}, Corners{o, n, p[2]}, Corners{m, n, o}})
                split(part);
        }
    }

    // As dicing has it: by inner products of the triangle's edges.
    double square(DicePoint a, DicePoint b) const {
        const uint32_t* c = &group_->triangles[3 * triangle_];
        dvec3 p0(base_.positions[c[0]]);
        dvec3 e1 = dvec3(base_.positions[c[1]]) - p0, e2 = dvec3(base_.positions[c[2]]) - p0;
        double i = double(a.i) - double(b.i), j = double(a.j) - double(b.j);
        return i * i * glm::dot(e1, e1) + 2 * i * j * glm::dot(e1, e2) + j * j * glm::dot(e2, e2);
    }

    void emit(const Corners& p) {
        const VertexAttribute& st = group_->definition->attributes[1];
        for (DicePoint at : p) {
            Weights of_positions;
            std::map<std::array<uint32_t, 3>, uint32_t> of_wedges;
            std::array<uint32_t, 3> inside = {kNone, kNone, kNone};
            for (int k = 0; k < 3; ++k) {
                const size_t c = 3 * triangle_ + size_t(k);
                if (at.weight(k) == 0) continue;
                of_positions[group_->triangles[c]] = at.weight(k);
                of_wedges[{group_->normal_corners[c], st.corners[c], 0}] = at.weight(k);
            }
            if (of_positions.size() == 3) inside = {uint32_t(triangle_), 0, 0};
            const uint32_t next = uint32_t(wedge_positions.back().size());
            auto [wedge, is_new] = wedges_.try_emplace({of_wedges, inside}, next);
            if (is_new) {
                if (of_positions.size() == 3)  // of this triangle alone, whatever its corners
                    of_positions[kNone] = uint32_t(positions_.size());
                wedge_positions.back().push_back(
                    positions_.try_emplace(of_positions, uint32_t(positions_.size()))
                        .first->second);
            }
            corners.back().push_back(wedge->second);
        }
    }

    const Mesh& base_;
    Rule longer_;
    const MeshGroup* group_ = nullptr;
    size_t triangle_ = 0;
    std::map<Weights, uint32_t> positions_;
    std::map<std::pair<std::map<std::array<uint32_t, 3>, uint32_t>, std::array<uint32_t, 3>>,
             uint32_t>
        wedges_;
};

DicedMesh dice_with(int threads, const Mesh& base, double longest, bool stencils) {
    const int before = thread_count();
    set_thread_count(threads);
    const std::vector<uint8_t> all(base.groups.size(), 1);
    auto longer = [&](const uint32_t corners[3], DicePoint a, DicePoint b, double times) {
        return glm::length(place(base, corners, b) - place(base, corners, a)) > longest * times;
    };
    std::optional<DicedParts> parts = dice_parts(base, all, longer, 10'000'000);
    EXPECT_TRUE(parts.has_value());
    DicedMesh made = diced_mesh(base, all, *parts, stencils);
    EXPECT_EQ(parts->triangles, made.triangles());
    set_thread_count(before);
    return made;
}

TEST(DicedMesh, HasTheTrianglesAndNumbersOfItsDefinitionOnAnyThreads) {
    const MeshDefinition definition = bent_grid(5);
    const Mesh base = build_mesh(definition, true);
    // Of the last, squares of the far rim are cut into parts.
    for (double longest : {10.0, 0.15, 0.033}) {
        const Definition expected(base, [&](const uint32_t* corners, DicePoint a, DicePoint b) {
            return glm::length(place(base, corners, b) - place(base, corners, a)) > longest;
        });
        for (int threads : {1, 2, 5}) {
            const DicedMesh made = dice_with(threads, base, longest, threads == 2);
            ASSERT_EQ(made.groups.size(), expected.corners.size());
            EXPECT_EQ(made.mesh.positions.size(), expected.positions());
            for (size_t g = 0; g < made.groups.size(); ++g) {
                ASSERT_TRUE(made.groups[g].corners == expected.corners[g]) << longest;
                ASSERT_TRUE(made.groups[g].position == expected.wedge_positions[g]) << longest;
            }
        }
    }
}

TEST(DicedMesh, PutsEveryVertexWhereItsCornersSay) {
    const MeshDefinition definition = bent_grid(4);
    const Mesh base = build_mesh(definition, true);
    const DicedMesh with = dice_with(2, base, 0.02, true),
                    without = dice_with(2, base, 0.02, false);
    EXPECT_TRUE(without.position_stencils.empty() && without.normal_stencils.empty());
    EXPECT_TRUE(with.mesh.positions == without.mesh.positions);
    EXPECT_TRUE(with.mesh.normals == without.mesh.normals);
    ASSERT_EQ(with.position_stencils.size(), with.mesh.positions.size());
    for (size_t g = 0; g < with.groups.size(); ++g) {
        const MeshGroup& group = with.mesh.groups[g];
        const VertexAttribute& st = group.definition->attributes[0];
        ASSERT_EQ(group.triangles.size(), with.groups[g].corners.size());
        for (size_t c = 0; c < group.triangles.size(); ++c) {
            const vec4& p = with.mesh.positions[group.triangles[c]];
            // Texture coordinates are x and y, but for the seam; normals are linear between
            // corners.
            const float s = st.values[2 * st.corners[c]], t = st.values[2 * st.corners[c] + 1];
            const double x = p.x + base.anchor.x, y = p.y + base.anchor.y;
            EXPECT_NEAR(std::min(std::abs(s - x), std::abs(s - x - 1)), 0, 2e-6);
            EXPECT_NEAR(t, y, 2e-6);
            const uint32_t n = group.normal_corners[c];
            EXPECT_EQ(with.mesh.normal_positions[n], group.triangles[c]);
            EXPECT_NEAR(glm::length(vec3(with.mesh.normals[n])), 1, 1e-6);
        }
    }
}

TEST(DicedMesh, IsNotMadeAboveTheLimit) {
    const MeshDefinition definition = bent_grid(3);
    const Mesh base = build_mesh(definition, true);
    const std::vector<uint8_t> all(base.groups.size(), 1);
    auto always = [](const uint32_t*, DicePoint, DicePoint, double) { return true; };
    EXPECT_FALSE(dice_parts(base, all, always, 5000).has_value());
}

TEST(Weld, FindsTheFirstOfEqualPositions) {
    std::mt19937 random(11);
    std::vector<vec4> positions;
    std::map<std::array<float, 3>, uint32_t> first;
    std::vector<uint32_t> expected;
    for (uint32_t p = 0; p < 40'000; ++p) {
        auto number = [&] { return (float(random() % 41) - 20) * 0.25f; };  // also 0
        vec4 at(number(), number(), number(), 0.0f);
        if (p % 3 == 0 && at.y == 0) at.y = -0.0f;
        positions.push_back(at);
        expected.push_back(first.try_emplace({at.x, at.y, at.z}, p).first->second);
    }
    EXPECT_EQ(weld(positions), expected);
    EXPECT_TRUE(weld({}).empty());
}

}  // namespace
}  // namespace kinora
