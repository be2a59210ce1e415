// tests/runtime/displacement_scenes.h: scenes with displaced meshes, and what their tests ask of
// them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "scene_text.h"

namespace kinora {

inline constexpr const char* kPlain = "surface plain() { Oi = 1; Ci = 1; }\n";
inline constexpr const char* kDisplaced =
    "<shader stage=\"DISPLACEMENT\"/><shader stage=\"SURFACE\"/>";
inline constexpr const char* kTransformed =
    "<shader stage=\"TRANSFORMATION\"/><shader stage=\"SURFACE\"/>";

inline SceneText square_scene(const std::string& code, const std::string& passes = kDisplaced,
                              const std::string& transforms = "") {
    SceneText scene;
    scene.square("floor").look("look", code + kPlain, passes);
    scene.place("floor", "look", transforms, "floor-node");
    return scene;
}

inline SceneOptions dice_of(double pixels, int width = 64) {
    SceneOptions options;
    options.quality.dice = pixels;
    options.width = options.height = width;
    return options;
}

inline const Mesh& mesh_of(const Rendering& r, size_t shape = 0) {
    return r.scene->meshes[r.scene->shapes[shape].mesh];
}
inline dvec3 position(const Mesh& mesh, size_t p) {
    return dvec3(mesh.positions[p]) + mesh.anchor;
}
// World positions of a shape whose vertices are in accel space.
inline std::vector<dvec3> world_positions(const Rendering& r, size_t shape = 0) {
    std::vector<dvec3> result;
    for (const vec4& p : r.pose->shapes[shape].shown_positions)
        result.push_back(dvec3(p) + r.scene->origin);
    return result;
}

// Every edge, by the bits of its ends' places, has as many triangles on one side as on the other.
inline void expect_closed(const Mesh& mesh, size_t least = 500) {
    const std::vector<vec4>& positions = mesh.positions;
    using Place = std::array<float, 3>;
    std::map<std::pair<Place, Place>, int> edges;
    auto place = [&](uint32_t p) {
        return Place{positions[p].x + 0.0f, positions[p].y + 0.0f, positions[p].z + 0.0f};
    };
    size_t triangles = 0;
    for (const MeshGroup& group : mesh.groups)
        for (size_t k = 0; k < group.triangles.size(); ++k, triangles += k % 3 == 0) {
            Place a = place(group.triangles[k]);
            Place b = place(group.triangles[k - k % 3 + (k + 1) % 3]);
            if (a < b)
                ++edges[{a, b}];
            else
                --edges[{b, a}];
        }
    size_t open = 0;
    for (const auto& [edge, count] : edges) open += count != 0;
    EXPECT_EQ(open, 0u) << "of " << edges.size();
    EXPECT_GT(triangles, least);
}

}  // namespace kinora
