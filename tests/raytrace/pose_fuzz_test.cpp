// tests/raytrace/pose_fuzz_test.cpp: random scenes whose surfaces collapse to points and lines and
// come back. Embree's assertions end the process, so the fuzzer's first claim is that it ends.
// KINORA_FUZZ_POSES=N sets how many scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "raytrace/brute_force.h"
#include "tests/fuzz_settings.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

// Few spots, so that surfaces collapse to the same one. At the last a float's step is 8.
constexpr vec3 kSpots[] = {{0, 0, 0}, {0.5f, -0.3f, 0.2f}, {0.5f, -0.3f, 1e8f}};

struct Actor {
    TestMesh rest, mesh;
    vec3 place{0.0f};  // of the rest pose
};

struct Pick {
    std::mt19937 random;
    uint32_t below(uint32_t n) { return uint32_t(random() % n); }
    vec3 spot() { return kSpots[below(uint32_t(std::size(kSpots)))]; }
    vec3 near_spot() { return kSpots[below(2)]; }
};

vec4 at(vec3 p) {
    return vec4(p, 0.0f);
}

void to_rest(Actor& a, Pick&) {
    for (size_t i = 0; i < a.rest.positions.size(); ++i)
        a.mesh.positions[i] = at(vec3(a.rest.positions[i]) + a.place);
}

void to_point(Actor& a, Pick& pick) {
    std::ranges::fill(a.mesh.positions, at(pick.spot()));
}

// As a hidden hand: from here on all vertices lie in one point. Few places to cut, so that the same
// triangles collapse again; near, since floats know little of triangles that reach far.
void partly_to_point(Actor& a, Pick& pick) {
    to_rest(a, pick);
    const size_t from = a.mesh.positions.size() * (1 + pick.below(3)) / 4;
    std::fill(a.mesh.positions.begin() + long(from), a.mesh.positions.end(), at(pick.near_spot()));
}

void to_line(Actor& a, Pick& pick) {
    const vec3 spot = pick.spot();
    const int axis = int(pick.below(3));
    for (size_t i = 0; i < a.rest.positions.size(); ++i) {
        vec3 p = spot;
        p[axis] += a.rest.positions[i].x;
        a.mesh.positions[i] = at(p);
    }
}

// Around FLT_MIN, where Embree's arithmetic makes zeros; and sizes that are nearly nothing.
void to_tiny(Actor& a, Pick& pick) {
    constexpr float kScales[] = {1e-45f, 1e-39f, 1e-38f, 2e-38f, 1e-37f, 1e-30f, 1e-12f, 1e-7f};
    const float scale = kScales[pick.below(uint32_t(std::size(kScales)))];
    const vec3 spot = pick.spot();
    for (size_t i = 0; i < a.rest.positions.size(); ++i)
        a.mesh.positions[i] = at(vec3(a.rest.positions[i]) * scale + spot);
}

void partly_bad(Actor& a, Pick& pick) {
    to_rest(a, pick);
    const size_t step = 1 + pick.below(5);
    for (size_t i = 0; i < a.mesh.positions.size(); i += step)
        a.mesh.positions[i].y = pick.below(2) ? kNaN : kInf;
}

constexpr void (*kPoses[])(Actor&, Pick&) = {to_rest,    to_rest,         to_point,
                                             to_point,   to_line,         to_tiny,
                                             partly_bad, partly_to_point, partly_to_point};

// A matrix that hides an instance, or one that shows it.
dmat4 some_matrix(Pick& pick) {
    constexpr double kScales[] = {1, 1, 0.5, 0, 1e-9, 1e-8, 1e-11};
    const double scale = kScales[pick.below(uint32_t(std::size(kScales)))];
    dmat4 m(scale);
    m[3] = dvec4(dvec3(pick.spot()), 1.0);
    return m;
}

struct RandomScene {
    Pick pick;
    std::vector<std::unique_ptr<Actor>> actors;
    std::vector<Geometry> rows;

    explicit RandomScene(uint64_t seed) : pick{std::mt19937(uint32_t(seed))} {
        const uint32_t deforming = 1 + pick.below(8);
        for (uint32_t i = 0; i < deforming; ++i) add(GeometryKind::Deforming);
        for (uint32_t i = pick.below(3); i-- > 0;) add(GeometryKind::Static);
        for (uint32_t i = pick.below(4); i-- > 0;) add(GeometryKind::Instanced);
    }
    void add(GeometryKind kind) {
        Actor& a = *actors.emplace_back(std::make_unique<Actor>());
        a.rest = pick.below(3) ? sphere(0.4, {0, 0, 0}, 6 + int(pick.below(6)), 5)
                               : soup(1 + pick.below(4), 0.3, 0.3, pick.below(1000));
        a.place = vec3(float(pick.below(5)) - 2, float(pick.below(5)) - 2, 0) * 0.4f;
        a.mesh = a.rest;
        pose(a);
        rows.push_back(a.mesh.geometry(uint32_t(rows.size()), kind));
        rows.back().opaque = pick.below(2);
        if (kind == GeometryKind::Instanced) rows.back().accel_from_local = some_matrix(pick);
    }
    void pose(Actor& a) { kPoses[pick.below(uint32_t(std::size(kPoses)))](a, pick); }
    void move_on() {
        for (size_t i = 0; i < rows.size(); ++i) {
            if (rows[i].kind == GeometryKind::Static || pick.below(3) == 0) continue;
            if (rows[i].kind == GeometryKind::Instanced)
                rows[i].accel_from_local = some_matrix(pick);
            if (rows[i].kind == GeometryKind::Instanced && pick.below(2)) continue;
            pose(*actors[i]);
            ++rows[i].positions_version;
        }
    }
};

AccelPolicy some_policy(Pick& pick) {
    AccelPolicy policy;
    policy.robust = pick.below(2);
    policy.always_rebuild = pick.below(4) == 0;
    policy.background = pick.below(2);
    policy.fixed_winner = pick.below(4) != 0;
    return policy;
}

struct Counts {
    int hits = 0, edges = 0, wrong = 0;
};

bool near_edge(double u, double v) {
    const double margin = 1e-4;
    return u < margin || v < margin || u + v > 1 - margin;
}

// Near an edge, and where surfaces cross, rounding may choose another triangle or none.
bool may_differ(const ReferenceHit& want, const OneHit& got) {
    if (want.geometry == kNone) return near_edge(double(got.u), double(got.v));
    return near_edge(want.u, want.v) ||
           (got.hit && std::abs(double(got.t) - want.t) < 1e-5 * want.t);
}

void compare(const Accel& accel, const RandomScene& scene, Counts& counts) {
    RandomRays rays(5);
    for (int i = 0; i < 60; ++i) {
        vec3 org, dir;
        rays.next(4, dvec3(0.0), org, dir);
        const OneHit got = shoot(accel, org, dir);
        const ReferenceHit want = brute_force(scene.rows, {dvec3(org), dvec3(dir)});
        const bool same =
            got.hit == (want.geometry != kNone) &&
            (!got.hit || (got.geometry == want.geometry && got.primitive == want.primitive));
        counts.hits += want.geometry != kNone;
        if (!same) ++(may_differ(want, got) ? counts.edges : counts.wrong);
    }
}

Counts run_scene(uint64_t seed) {
    RandomScene scene(seed);
    Accel accel(some_policy(scene.pick));
    Counts counts;
    for (int frame = 0; frame < 6; ++frame) {
        accel.update(scene.rows);
        compare(accel, scene, counts);
        if (scene.pick.below(2)) accel.wait_for_background();
        scene.move_on();
    }
    return counts;
}

TEST(PoseFuzz, SurfacesThatCollapseAndComeBackAreTracedAsByBruteForce) {
    const uint64_t scenes = fuzz_setting("KINORA_FUZZ_POSES", 100);
    Counts all;
    for (uint64_t first : {fuzz_setting("KINORA_FUZZ_SEED", 1), fresh_seed()})
        for (uint64_t seed = first; seed < first + scenes; ++seed) {
            const Counts counts = run_scene(seed);
            EXPECT_EQ(counts.wrong, 0) << "seed " << seed;
            all.hits += counts.hits;
            all.edges += counts.edges;
        }
    EXPECT_GT(all.hits, int(scenes) * 60);
    EXPECT_LT(all.edges, all.hits / 100);
}

}  // namespace
}  // namespace kinora::raytrace::test
