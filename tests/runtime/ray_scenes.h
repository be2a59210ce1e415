// tests/runtime/ray_scenes.h: scenes of a few planes, of which it is known where rays go.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "scene_text.h"

namespace kinora {

// A floor that fills the picture and, at x = 1, a wall of a height, endless along y for all
// purposes, with its normal towards the floor's middle (-x).
inline SceneText floor_and_wall(const std::string& floor, const std::string& wall, double height) {
    SceneText scene;
    scene.square("floor", 1.5).look("floor-look", floor).place("floor", "floor-look");
    scene.look("wall-look", wall);
    scene.mesh("wall", {{0, -5000, -1}, {0, -5000, height}, {0, 5000, height}, {0, 5000, -1}},
               {0, 1, 2, 0, 2, 3}, std::vector<dvec3>(4, dvec3(-1, 0, 0)));
    scene.place("wall", "wall-look", "<translate>1.25 0 0</translate>");
    return scene;
}

// A box around everything, the camera too.
inline void add_box(SceneText& scene, const std::string& code, double s = 40) {
    scene.look("box-look", code);
    std::vector<dvec3> corners;
    for (int k = 0; k < 8; ++k) corners.push_back({k & 1 ? s : -s, k & 2 ? s : -s, k & 4 ? s : -s});
    scene.mesh("box", corners, {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5});
    scene.place("box", "box-look");
}

inline std::string floor_code(const std::string& body) {
    return "surface floor() { Oi = 1; Ci = 0; normal n = normalize(N);"
           " vector up = vector \"world\" (0, 0, 1), right = vector \"world\" (1, 0, 0); " +
           body + " }";
}
inline constexpr const char* kBlack = "surface black() { Oi = 1; Ci = 0; }";

// What a point of the floor sees of the wall: half of 1 - cos(elevation of its top) (the form
// factor of two perpendicular strips; Siegel and Howell, Thermal Radiation Heat Transfer).
inline double wall_share(double x, double height) {
    double d = 1.25 - x;
    return 0.5 * (1 - d / std::sqrt(d * d + height * height));
}

}  // namespace kinora
