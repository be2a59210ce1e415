// tests/runtime/moving_parts_test.cpp: a frame brings up to date what an animation can move.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/scene/scene.h"
#include "scene_text.h"

namespace kinora {
namespace {

// 200 squares in a grid; every 50th crosses it in a second, from below to above.
SceneText squares(bool move) {
    SceneText scene;
    scene.square("square", 0.05).look("look", kMatte).light("sun", kSun);
    for (int k = 0; k < 200; ++k) {
        const std::string id = fmt::format("n{}", k);
        scene.place("square", "look",
                    fmt::format("<translate sid=\"to\">{} {} 0</translate>", 0.1 * (k % 20) - 0.95,
                                0.1 * (k / 20) - 0.45),
                    id);
        if (move && k % 50 == 3) scene.animate(id + "/to.Y", {0, 1}, {-0.9, 0.9});
    }
    return scene;
}

TEST(MovingParts, AreAllThatAFrameLooksAt) {
    Rendering r(squares(true).text());
    r.frame(64, 64, 0);
    EXPECT_EQ(r.scene->moving.nodes.size(), 4u);
    EXPECT_EQ(r.scene->moving.surfaces.size(), 4u);
    const raytrace::Film first = r.film;
    for (double time : {0.5, 1.0}) {
        r.frame(64, 64, time);
        EXPECT_EQ(r.stats.rows_compared, 4u);
        EXPECT_GT(different_pixels(first, r.film, 0.1f), 10u);
        // The same picture as of a scene that begins there.
        Rendering alone(squares(true).text());
        EXPECT_TRUE(same_bytes(alone.frame(64, 64, time).film, r.film));
    }
    EXPECT_TRUE(same_bytes(r.frame(64, 64, 0).film, first));
}

TEST(MovingParts, AreNoneOfAStaticScene) {
    Rendering r(squares(false).text());
    r.frame(32, 32, 0).frame(32, 32, 1);
    EXPECT_TRUE(r.scene->moving.nodes.empty());
    EXPECT_EQ(r.stats.rows_compared, 0u);
}

}  // namespace
}  // namespace kinora
