// tests/runtime/transforms_test.cpp: node operations and the hierarchy against matrices by hand.
#include "runtime/scene/transforms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene_text.h"

namespace kinora {
namespace {

dvec3 apply(const dmat4& m, dvec3 p) {
    return dvec3(m * dvec4(p, 1.0));
}
dmat4 operation(TransformKind kind, std::vector<double> values) {
    return transform_matrix(kind, values.data());
}
void expect_near(dvec3 got, dvec3 want, double tolerance = 1e-12) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], want[k], tolerance) << "component " << k;
}

TEST(Transforms, TranslateAdds) {
    expect_near(apply(operation(TransformKind::Translate, {1, -2, 3}), {10, 20, 30}), {11, 18, 33});
}

TEST(Transforms, ScaleMultiplies) {
    expect_near(apply(operation(TransformKind::Scale, {2, -3, 0}), {1, 1, 5}), {2, -3, 0});
}

TEST(Transforms, RotateTurnsAnticlockwiseAboutItsAxisInDegrees) {
    const double c = std::sqrt(3.0) / 2;
    expect_near(apply(operation(TransformKind::Rotate, {0, 0, 1, 30}), {1, 0, 5}), {c, 0.5, 5});
    expect_near(apply(operation(TransformKind::Rotate, {1, 0, 0, 90}), {7, 1, 0}), {7, 0, 1});
    expect_near(apply(operation(TransformKind::Rotate, {0, 5, 0, 90}), {0, 7, 1}), {1, 7, 0});
    // About the diagonal by a third of a turn: x to y to z to x.
    expect_near(apply(operation(TransformKind::Rotate, {1, 1, 1, 120}), {1, 2, 3}), {3, 1, 2});
}

TEST(Transforms, ARotationAboutNoAxisIsNone) {
    EXPECT_EQ(operation(TransformKind::Rotate, {0, 0, 0, 77}), dmat4(1.0));
}

TEST(Transforms, AnglesReachFarBeyondOneTurn) {
    expect_near(apply(operation(TransformKind::Rotate, {0, 0, 1, 720}), {1, 2, 3}), {1, 2, 3});
    // 1e7 = 27777 * 360 + 280.
    double a = radians(280.0);
    expect_near(apply(operation(TransformKind::Rotate, {0, 0, 1, 1e7}), {1, 0, 0}),
                {std::cos(a), std::sin(a), 0});
    expect_near(apply(operation(TransformKind::Rotate, {0, 0, 1, -1e7}), {1, 0, 0}),
                {std::cos(a), -std::sin(a), 0});
}

TEST(Transforms, MatricesAreWrittenRowByRow) {
    dmat4 m = operation(TransformKind::Matrix, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1});
    expect_near(apply(m, {1, 0, 0}), {5, 13, 21});
    expect_near(apply(m, {0, 0, 1}), {7, 15, 23});
}

TEST(Transforms, TheLastRowOfAMatrixIsTakenForAffine) {
    dmat4 m = operation(TransformKind::Matrix, {1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 7, 8, 9, 2});
    EXPECT_EQ(glm::transpose(m)[3], dvec4(0, 0, 0, 1));
}

TEST(Transforms, LookatPlacesTheEyeAndLooksDownMinusZ) {
    dmat4 m = operation(TransformKind::Lookat, {1, 2, 3, 1, 2, -7, 0, 1, 0});
    expect_near(apply(m, {0, 0, 0}), {1, 2, 3});
    expect_near(apply(m, {0, 0, -10}), {1, 2, -7});
    m = operation(TransformKind::Lookat, {0, 0, 0, 5, 0, 0, 0, 0, 2});
    expect_near(apply(m, {0, 0, -1}), {1, 0, 0});
    expect_near(apply(m, {0, 1, 0}), {0, 0, 1});
    expect_near(apply(m, {1, 0, 0}), {0, -1, 0});
}

TEST(Transforms, ALookatWhoseUpLiesAlongItsViewHasAFixedAxis) {
    // Right is x, so that up in a view from above is away from the viewer; -y where x is the view.
    struct {
        dvec3 view, right;
    } rows[] = {{{0, 1, 0}, {1, 0, 0}},  {{0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 0}},
                {{0, 0, -1}, {1, 0, 0}}, {{1, 0, 0}, {0, -1, 0}}, {{-1, 0, 0}, {0, -1, 0}}};
    for (const auto& row : rows)
        for (double noise : {0.0, 1e-14, -1e-14}) {
            dvec3 to = dvec3(1, 2, 3) + 5.0 * row.view;
            dmat4 m = operation(TransformKind::Lookat, {1 + noise, 2 - noise, 3 + noise, to.x, to.y,
                                                        to.z, row.view.x, row.view.y, row.view.z});
            dvec3 up = glm::cross(row.right, row.view);
            expect_near(apply(m, {0, 0, 0}), {1, 2, 3});
            expect_near(apply(m, {1, 0, 0}), dvec3(1, 2, 3) + row.right);
            expect_near(apply(m, {0, 1, 0}), dvec3(1, 2, 3) + up);
            expect_near(apply(m, {0, 0, -5}), to);
        }
    dmat4 still = operation(TransformKind::Lookat, {1, 2, 3, 1, 2, 3, 0, 1, 0});
    expect_near(apply(still, {1, 0, -1}), {2, 2, 2});
}

TEST(Transforms, SkewMovesAlongTheFirstAxisByTheTangentOfTheAngle) {
    // y grows by x tan 30.
    dmat4 m = operation(TransformKind::Skew, {30, 0, 5, 0, 2, 0, 0});
    expect_near(apply(m, {1, 0, 0}), {1, std::tan(radians(30.0)), 0});
    expect_near(apply(m, {0, 5, 7}), {0, 5, 7});
    // Any axes, by hand: d1 = (0.6, 0.8, 0), d2 = (0, 0.6, 0.8), tan 45 = 1, p . d2 = 1.8 + 4.
    m = operation(TransformKind::Skew, {45, 3, 4, 0, 0, 3, 4});
    expect_near(apply(m, {1, 3, 5}), {1 + 5.8 * 0.6, 3 + 5.8 * 0.8, 5});
    m = operation(TransformKind::Skew, {45, 3, 4, 0, 3, 4, 0});  // one axis: it is stretched
    expect_near(apply(m, {0.6, 0.8, 1}), {1.2, 1.6, 1});
}

TEST(Transforms, ASkewWithoutATangentOrAnAxisIsTheIdentity) {
    const std::vector<std::vector<double>> cases{{90, 1, 0, 0, 0, 1, 0},
                                                 {-270, 1, 0, 0, 0, 1, 0},
                                                 {30, 0, 0, 0, 0, 1, 0},
                                                 {30, 1, 0, 0, 0, 0, 0}};
    for (const std::vector<double>& v : cases)
        EXPECT_EQ(operation(TransformKind::Skew, v), dmat4(1.0));
}

TEST(Transforms, OperationsApplyLastFirst) {
    SceneText scene;
    scene.square("s").look("l", "surface s() { Ci = 1; }");
    scene.place("s", "l",
                "<translate>1 0 0</translate><rotate>0 0 1 90</rotate><scale>2 2 2</scale>");
    Rendering r(scene.text());
    ASSERT_TRUE(r.scene) << r.findings();
    const NodePose& node = r.scene->start.nodes[r.scene->shapes[0].node];
    expect_near(apply(node.world, {1, 0, 0}), {1, 2, 0});
}

TEST(Transforms, ChildrenFollowTheirParentsAlsoWhenThoseMove) {
    SceneText scene;
    scene.square("s").look("l", "surface s() { Ci = 1; }");
    scene.nodes =
        "<node id=\"a\"><rotate sid=\"r\">0 0 1 0</rotate><node><translate>1 0 0</translate>"
        "<node id=\"leaf\"><translate>0 1 0</translate></node></node></node>";
    scene.place("s", "l").animate("a/r.ANGLE", {0, 1}, {0, 720});
    Rendering r(scene.text());
    auto leaf = [&] {
        for (size_t n = 0; n < r.scene->nodes.size(); ++n)
            if (r.scene->description->nodes[r.scene->nodes[n].definition].id == "leaf")
                return r.pose->nodes[n].world;
        return dmat4(0.0);
    };
    r.frame(0);
    expect_near(apply(leaf(), {0, 0, 0}), {1, 1, 0});
    r.frame(0.125);  // 90 of 720 degrees
    expect_near(apply(leaf(), {0, 0, 0}), {-1, 1, 0}, 1e-9);
    r.frame(0.375);  // 270: angles are numbers, two whole turns
    expect_near(apply(leaf(), {0, 0, 0}), {1, -1, 0}, 1e-9);
    r.frame(1);
    expect_near(apply(leaf(), {0, 0, 0}), {1, 1, 0}, 1e-9);
}

}  // namespace
}  // namespace kinora
