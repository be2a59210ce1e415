// tests/runtime/scene/gltf/import_gltf_blender_test.cpp: a skin on morphs and a moving box,
// exported by Blender, against the vertices of Blender's own evaluation
// (scripts/assets/make_gltf.py).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "tests/folders.h"
#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

const std::string kFolder = project_folder() + "/assets/gltf/";

// World positions of the shape on the node with that name, whatever kind it is.
std::vector<dvec3> positions_of(const Scene& scene, const Pose& pose, std::string_view node) {
    std::vector<dvec3> positions;
    for (size_t s = 0; s < scene.shapes.size(); ++s) {
        const Shape& shape = scene.shapes[s];
        if (scene.description->nodes[scene.nodes[shape.node].definition].id != node) continue;
        const Mesh& mesh = scene.meshes[shape.mesh];
        bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
        for (const vec4& p : pose.shapes[s].shown_positions)
            positions.push_back(
                instanced ? dvec3(pose.nodes[shape.node].world * dvec4(dvec3(p) + mesh.anchor, 1.0))
                          : dvec3(p) + scene.origin);
    }
    return positions;
}

double nearest(dvec3 p, const std::vector<dvec3>& positions) {
    double best = 1e300;
    for (dvec3 q : positions) best = std::min(best, glm::length(p - q));
    return best;
}

TEST(GltfFromBlender, VerticesAreWhereBlenderHasThem) {
    std::ifstream file(kFolder + "bender.json");
    nlohmann::json frames = nlohmann::json::parse(file);
    auto r = Rendering::of_file(kFolder + "bender.glb");
    ASSERT_TRUE(r->scene) << r->findings();
    double moved = 0;
    std::vector<dvec3> before;
    for (const auto& frame : frames) {
        r->frame(frame["time"].get<double>());
        for (const char* node : {"post", "box"}) {
            std::vector<dvec3> ours = positions_of(*r->scene, *r->pose, node), theirs;
            for (const auto& p : frame["places"][node])
                theirs.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
            ASSERT_FALSE(ours.empty()) << node;
            // glTF splits vertices where normals do: the same set of positions.
            for (dvec3 p : theirs)
                EXPECT_LT(nearest(p, ours), 2e-5) << node << " at " << frame["time"];
            for (dvec3 p : ours) EXPECT_LT(nearest(p, theirs), 2e-5) << node;
            if (std::string_view(node) == "post") {
                if (!before.empty()) moved = std::max(moved, glm::length(before[20] - theirs[20]));
                before = theirs;
            }
        }
    }
    EXPECT_GT(moved, 0.1);  // or it would not say much
}

TEST(GltfFromBlender, LightsAreTakenForTheWattsTheyWere) {
    auto r = Rendering::of_file(kFolder + "bender.glb");
    EXPECT_EQ(r->count("GLTF_LIGHT_WATTS"), 1);
    r->frame(32, 24, 1.0);
    float brightest = 0;
    for (const vec4& p : r->film.rgba) brightest = std::max(brightest, p.x);
    EXPECT_GT(brightest, 0.2f);
    EXPECT_LT(brightest, 20.0f);
}

}  // namespace
}  // namespace kinora
