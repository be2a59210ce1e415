// tests/collada/scenes_test.cpp: all scenes by others are read without an Error.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "collada/extract/extract.h"
#include "collada/scene/scene.h"
#include "tests/shared.h"

namespace kinora::collada {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = shared_scenes();

std::vector<fs::path> scene_files() {
    std::vector<fs::path> files;
    if (!fs::exists(kScenes)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(kScenes)) {
        std::string extension = entry.path().extension().string();
        if (extension == ".dae" || extension == ".DAE") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

bool is_library_only(const fs::path& path) {
    return path.filename() == "library_geometries.dae";
}

// Every index of the scene must be in range: the promise of scene.h.
void check_indices(const SceneData& s) {
    auto below = [](uint32_t index, size_t size) { return index == kNone || index < size; };
    for (const Node& n : s.nodes) {
        for (uint32_t c : n.children) ASSERT_LT(c, s.nodes.size());
        for (const auto& i : n.instances) ASSERT_LT(i.node, s.nodes.size());
        for (const auto& l : n.lights) ASSERT_LT(l.light, s.lights.size());
        for (const auto& c : n.cameras) ASSERT_LT(c.camera, s.cameras.size());
        for (const MeshInstance& m : n.meshes) {
            ASSERT_LT(m.geometry, s.geometries.size());
            ASSERT_TRUE(below(m.morph, s.morphs.size()));
            ASSERT_TRUE(below(m.skin, s.skins.size()));
            if (m.skin != kNone) {
                ASSERT_EQ(m.joint_nodes.size(), s.skins[m.skin].joints.size());
            }
            for (uint32_t j : m.joint_nodes) ASSERT_TRUE(below(j, s.nodes.size()));
            for (const auto& b : m.materials) ASSERT_TRUE(below(b.material, s.materials.size()));
        }
    }
    for (const Geometry& g : s.geometries)
        for (const PrimitiveGroup& group : g.groups) {
            ASSERT_GT(group.triangle_count(), 0u);
            for (uint32_t i : group.indices[0]) ASSERT_LT(i, g.positions.size());
            for (const VertexInput& input : group.inputs) {
                const FloatSource& source = g.sources[input.source];
                ASSERT_EQ(group.indices[input.list].size(), group.indices[0].size());
                for (uint32_t i : group.indices[input.list])
                    ASSERT_LT(i, source.values.size() / source.stride);
            }
        }
    for (const Channel& c : s.channels) {
        ASSERT_NE(c.ref.kind, Owner::None);
        const Sampler& sampler = s.samplers[c.sampler];
        ASSERT_EQ(sampler.stride, c.ref.count);
        ASSERT_EQ(sampler.values.size(), sampler.times.size() * sampler.stride);
        ASSERT_TRUE(std::is_sorted(sampler.times.begin(), sampler.times.end()));
    }
}

TEST(Scenes, AllAreReadWithoutErrors) {
    std::vector<fs::path> files = scene_files();
    if (files.empty()) GTEST_SKIP() << "no ../shared/scenes";
    for (const fs::path& path : files) {
        Diagnostics diag;
        diag.judge(Judgement::Rendering);
        std::optional<Document> document = read_document(path.string(), diag);
        ASSERT_TRUE(document) << path;
        std::optional<SceneData> scene = extract(*document, diag);
        if (is_library_only(path)) {
            EXPECT_FALSE(scene);
            continue;
        }
        ASSERT_TRUE(scene) << path;
        check_indices(*scene);
        bool verbose = std::getenv("KINORA_VERBOSE") != nullptr;
        size_t triangles = 0;
        for (const Geometry& g : scene->geometries)
            for (const PrimitiveGroup& group : g.groups) triangles += group.triangle_count();
        if (verbose)
            std::cout << "== " << path.filename() << ": nodes " << scene->nodes.size() << " geo "
                      << scene->geometries.size() << " tri " << triangles << " skins "
                      << scene->skins.size() << " morphs " << scene->morphs.size() << " mat "
                      << scene->materials.size() << " img " << scene->images.size() << " ch "
                      << scene->channels.size() << " cam " << scene->cameras.size() << " light "
                      << scene->lights.size() << " clips " << scene->clips.size() << "\n";
        for (const Finding& f : diag.findings()) {
            EXPECT_NE(f.severity, Severity::Error) << format_finding(f, diag.files);
            if (verbose) std::cout << format_finding(f, diag.files);
        }
        EXPECT_GT(triangles + scene->cameras.size() + scene->lights.size(), 0u) << path;
    }
}

}  // namespace
}  // namespace kinora::collada
