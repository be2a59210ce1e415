// tests/runtime/scene/load/normals_test.cpp: normals of meshes that have none, and of morphs whose
// targets have more than their base; faces painted on both sides.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/build/shapes/mesh.h"
#include "runtime/scene/load/smooth_normals.h"
#include "runtime/scene/load/target_normals.h"
#include "runtime/scene/load/twin_faces.h"

namespace kinora {
namespace {

const double kRootHalf = std::sqrt(0.5);

MeshDefinition mesh_of(std::vector<dvec3> positions, std::vector<uint32_t> triangles) {
    MeshDefinition mesh;
    mesh.positions = std::move(positions);
    mesh.groups.emplace_back().triangles = std::move(triangles);
    return mesh;
}

MeshDefinition smoothed(MeshDefinition mesh, double degrees) {
    SceneDescription description;
    description.meshes.push_back(std::move(mesh));
    smooth_normals(description, degrees);
    return std::move(description.meshes[0]);
}

dvec3 normal_at(const MeshDefinition& mesh, size_t corner) {
    const VertexAttribute& a = mesh.groups[0].attributes.at(0);
    EXPECT_EQ(a.semantic, "NORMAL");
    const float* v = &a.values[3 * size_t(a.corners[corner])];
    return dvec3(double(v[0]), double(v[1]), double(v[2]));
}

void expect_normal(dvec3 got, dvec3 want) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], 1e-6) << "component " << k;
}

// The corner of a cube at the origin: three faces that meet at right angles.
MeshDefinition cube_corner() {
    return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 2, 1, 0, 1, 3, 0, 3, 2});
}

TEST(Smooth, CreasesWhereFacesTurnByMoreThanTheAngle) {
    // Two faces that meet at 45 degrees beside one that stands at a right angle to the first.
    MeshDefinition mesh =
        smoothed(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -1, -1}},
                         {0, 1, 2, 1, 0, 4, 0, 2, 3}),
                 60);
    expect_normal(normal_at(mesh, 6), {1, 0, 0});
    dvec3 joined = normal_at(mesh, 0);
    EXPECT_GT(joined.z, 0.9);
    EXPECT_LT(joined.y, -0.1);
    expect_normal(normal_at(mesh, 4), joined);
}

TEST(Smooth, AFlatMeshNeedsNoneUnlessTheyAreToBeWritten) {
    EXPECT_TRUE(smoothed(cube_corner(), 60).groups[0].attributes.empty());
    SceneDescription description;
    description.meshes.push_back(cube_corner());
    flat_normals(description);
    const MeshDefinition& mesh = description.meshes[0];
    expect_normal(normal_at(mesh, 0), {0, 0, -1});
    expect_normal(normal_at(mesh, 3), {0, -1, 0});
    expect_normal(normal_at(mesh, 6), {-1, 0, 0});
}

TEST(Smooth, JoinsFacesByTheirAngleAtTheVertex) {
    MeshDefinition mesh = smoothed(cube_corner(), 91);
    const double s = -1 / std::sqrt(3.0);
    for (size_t corner : {0u, 3u, 6u}) expect_normal(normal_at(mesh, corner), {s, s, s});
    // At (1, 0, 0) two faces meet, with 45 degrees each.
    for (size_t corner : {2u, 4u})
        expect_normal(normal_at(mesh, corner), {0, -kRootHalf, -kRootHalf});
    // A square's two triangles count as one right angle: 90 against 45 + 45.
    MeshDefinition step =
        smoothed(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}},
                         {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2}),
                 100);
    expect_normal(normal_at(step, 1), {-kRootHalf, 0, kRootHalf});
}

TEST(Smooth, EqualPositionsAreOne) {
    MeshDefinition whole = smoothed(cube_corner(), 91), soup = cube_corner();
    std::vector<dvec3> apart;
    for (uint32_t& p : soup.groups[0].triangles) {
        apart.push_back(soup.positions[p]);
        p = uint32_t(apart.size() - 1);
    }
    soup.positions = apart;
    soup = smoothed(soup, 91);
    for (size_t c = 0; c < 9; ++c) expect_normal(normal_at(soup, c), normal_at(whole, c));
}

TEST(Smooth, LeavesGivenNormalsAlone) {
    MeshDefinition mesh = cube_corner();
    mesh.groups[0].attributes.push_back({"NORMAL", 0, 3, {1, 0, 0}, std::vector<uint32_t>(9, 0)});
    mesh = smoothed(mesh, 91);
    EXPECT_EQ(mesh.groups[0].attributes.size(), 1u);
    expect_normal(normal_at(mesh, 4), {1, 0, 0});
}

TEST(Smooth, MorphTargetsGetThoseOfTheirShape) {
    SceneDescription description;
    description.meshes.push_back(cube_corner());
    MeshDefinition target = cube_corner();
    for (dvec3& p : target.positions) p *= dvec3(1, 1, 2);
    description.meshes.push_back(target);
    MorphDefinition& morph = description.morphs.emplace_back();
    morph.targets = {1};
    MeshUse& use = description.nodes.emplace_back().meshes.emplace_back();
    use.mesh = 0;
    use.morph = 0;
    smooth_normals(description, 91);
    uint32_t made = description.morphs[0].targets[0];
    EXPECT_EQ(made, 1u);  // nobody else uses it
    // The three faces have right angles at the corner still.
    const double s = -1 / std::sqrt(3.0);
    expect_normal(normal_at(description.meshes[made], 0), {s, s, s});
    // At (1, 0, 0): 45 degrees of the face below, atan 2 of the one in front.
    double below = std::atan(1.0), front = std::atan(2.0);
    expect_normal(normal_at(description.meshes[made], 2), glm::normalize(dvec3(0, -front, -below)));
}

// A sheet bent by 20 degrees, whose other edge a target folds: that is a crease from the start.
TEST(Smooth, ATargetsCreasesAreCreasesOfTheBase) {
    SceneDescription description;
    const double c = std::cos(radians(20.0)), s = std::sin(radians(20.0));
    MeshDefinition sheet =
        mesh_of({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1 + c, 0, s}, {-1, 0, 0}},
                {0, 2, 1, 2, 3, 1, 2, 4, 3, 0, 1, 5});
    description.meshes.push_back(sheet);
    for (dvec3& p : sheet.positions) p = {0, 0, p.x < 0 ? 1.0 : 0.0};
    description.meshes.push_back(sheet);  // lifts the corner on the left
    MorphDefinition& morph = description.morphs.emplace_back();
    morph.relative = true;
    morph.targets = {1};
    MeshUse& use = description.nodes.emplace_back().meshes.emplace_back();
    use.mesh = 0;
    use.morph = 0;
    smooth_normals(description, 40);
    const MeshDefinition& target = description.meshes[description.morphs[0].targets[0]];
    // At the fold the middle keeps its normal, and the left face turns by 45 degrees.
    for (size_t corner : {0u, 2u}) expect_normal(normal_at(target, corner), {0, 0, 0});
    for (size_t corner : {9u, 10u, 11u})
        expect_normal(normal_at(target, corner), {kRootHalf, 0, kRootHalf - 1});
}

// ---- targets that part the base's corners

// A square of two triangles with one normal, and a target whose triangles have one each.
SceneDescription square_and_target(std::vector<uint32_t> corners_of_target) {
    SceneDescription description;
    MeshDefinition mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3});
    MeshDefinition target = mesh;
    mesh.groups[0].attributes = {{"NORMAL", 0, 3, {0, 0, 1}, std::vector<uint32_t>(6, 0)}};
    target.groups[0].attributes = {
        {"NORMAL", 0, 3, {0, 1, 0, 1, 0, 0, 0, 1, 0}, std::move(corners_of_target)}};
    description.meshes = {mesh, target};
    description.morphs.emplace_back().targets = {1};
    MeshUse& use = description.nodes.emplace_back().meshes.emplace_back();
    use.mesh = 0;
    use.morph = 0;
    return description;
}

TEST(TargetNormals, PartTheCornersOfTheBase) {
    SceneDescription description = square_and_target({0, 0, 0, 1, 1, 1});
    part_normals_by_targets(description);
    const MeshDefinition& mesh = description.meshes[0];
    for (size_t corner = 0; corner < 6; ++corner) expect_normal(normal_at(mesh, corner), {0, 0, 1});
    // Each vertex of the diagonal has two entries, the others one: those of two flat triangles.
    const Mesh built = build_mesh(mesh, true);
    EXPECT_EQ(built.normals.size(), 6u);
    EXPECT_EQ(built.normal_positions, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(TargetNormals, EqualOnesPartNothing) {
    SceneDescription description = square_and_target({0, 2, 0, 2, 0, 2});
    part_normals_by_targets(description);
    EXPECT_EQ(description.meshes[0].groups[0].attributes[0].values.size(), 3u);
    EXPECT_EQ(build_mesh(description.meshes[0], true).normals.size(), 4u);
}

TEST(TargetNormals, OfOtherCornersDoNotCount) {
    SceneDescription description = square_and_target({0, 1, 2});
    part_normals_by_targets(description);
    EXPECT_EQ(description.meshes[0].groups[0].attributes[0].values.size(), 3u);
}

// ---- faces that lie on others

// Two triangles of one material; the first is there once more, the other way round.
MeshDefinition painted_on_both_sides(const std::string& other) {
    MeshDefinition mesh =
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, {0, 1, 2, 0, 2, 3});
    mesh.groups[0].symbol = "front";
    mesh.groups[0].attributes = {{"TEXCOORD", 0, 2, {0, 0, 1, 1}, {0, 1, 0, 1, 0, 1}}};
    PrimitiveGroup& back = mesh.groups.emplace_back();
    back.symbol = other;
    back.triangles = {2, 1, 4};  // 4 lies where 0 does
    return mesh;
}

MeshDefinition parted(MeshDefinition mesh) {
    SceneDescription description;
    description.meshes.push_back(std::move(mesh));
    part_twin_faces(description);
    return std::move(description.meshes[0]);
}

TEST(TwinFaces, OfTwoMaterialsAreSeenFromTheirFrontAlone) {
    const MeshDefinition mesh = parted(painted_on_both_sides("back"));
    ASSERT_EQ(mesh.groups.size(), 3u);
    EXPECT_TRUE(mesh.groups[0].one_sided);
    EXPECT_EQ(mesh.groups[0].triangles, (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(mesh.groups[0].attributes[0].corners, (std::vector<uint32_t>{0, 1, 0}));
    EXPECT_TRUE(mesh.groups[1].one_sided);
    // The triangle without a twin keeps both sides, and its corners.
    EXPECT_FALSE(mesh.groups[2].one_sided);
    EXPECT_EQ(mesh.groups[2].symbol, "front");
    EXPECT_EQ(mesh.groups[2].triangles, (std::vector<uint32_t>{0, 2, 3}));
    EXPECT_EQ(mesh.groups[2].attributes[0].corners, (std::vector<uint32_t>{1, 0, 1}));
}

TEST(TwinFaces, OfOneMaterialOrTurnedAlikeStayAsTheyAre) {
    EXPECT_EQ(parted(painted_on_both_sides("front")).groups.size(), 2u);
    MeshDefinition alike = painted_on_both_sides("back");
    alike.groups[1].triangles = {4, 1, 2};
    alike = parted(alike);
    EXPECT_EQ(alike.groups.size(), 2u);
    EXPECT_FALSE(alike.groups[0].one_sided);
}

}  // namespace
}  // namespace kinora
