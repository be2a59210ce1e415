// tests/runtime/kinora/open_scene_test.cpp: scenes of files and of bytes, changed, listed and
// rendered.
#include "runtime/kinora/kinora.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/kernels/kernel_probe.h"
#include "tests/folders.h"

namespace kinora {
namespace {

std::string bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

SceneRequest small_request(const std::string& scene) {
    SceneRequest request;
    request.scene = scene;
    request.width = 48;
    request.height = 27;
    request.quality = *find_quality(kDefaultQuality);
    request.quality.samples_per_pixel = 1;
    return request;
}

SceneRequest of_assets(const std::string& name) {
    return small_request(project_folder() + "/assets/" + name);
}

std::string text_of_findings(OpenScene& scene) {
    std::string text;
    for (const Finding& finding : scene.diagnostics().findings())
        text += format_finding(finding, scene.diagnostics().files);
    return text;
}

raytrace::Film rendered(OpenScene& scene, double seconds = 0.5) {
    raytrace::Film film;
    EXPECT_TRUE(scene.render(seconds, film)) << text_of_findings(scene);
    return film;
}

bool same_pixels(const raytrace::Film& a, const raytrace::Film& b) {
    return a.rgba.size() == b.rgba.size() && !a.rgba.empty() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(vec4)) == 0;
}

class OpenSceneOf : public testing::TestWithParam<const char*> {};

TEST_P(OpenSceneOf, BytesHasThePixelsOfTheFile) {
    const std::string file = project_folder() + "/" + GetParam();
    OpenScene of_file(small_request(file)), of_bytes(small_request(file));
    ASSERT_EQ(of_file.open(), SceneError::None) << text_of_findings(of_file);
    ASSERT_EQ(of_bytes.open(bytes_of(file)), SceneError::None) << text_of_findings(of_bytes);
    EXPECT_TRUE(same_pixels(rendered(of_file), rendered(of_bytes)));
    EXPECT_EQ(text_of_findings(of_file), text_of_findings(of_bytes));
}

INSTANTIATE_TEST_SUITE_P(All, OpenSceneOf,
                         testing::Values("assets/scenes/studio.dae", "assets/gltf/bender.glb"));

// This one holds nodes alone: its findings name its members.
TEST(OpenSceneOfBytes, OfAnArchiveAreReadAsTheFileIs) {
    const std::string file = project_folder() + "/tests/fuzzers/corpus/zae/deflated.zae";
    OpenScene of_file(small_request(file)), of_bytes(small_request(file));
    EXPECT_EQ(of_file.open(), of_bytes.open(bytes_of(file)));
    EXPECT_NE(text_of_findings(of_file).find("!scene.dae"), std::string::npos);
    EXPECT_EQ(text_of_findings(of_file), text_of_findings(of_bytes));
}

// The file is not there: relative references begin at its folder all the same.
TEST(OpenSceneOfBytes, NeedsNoFile) {
    OpenScene of_file(of_assets("scenes/studio.dae")), of_bytes(of_assets("scenes/none.dae"));
    ASSERT_EQ(of_file.open(), SceneError::None);
    ASSERT_EQ(of_bytes.open(bytes_of(of_file.request().scene)), SceneError::None)
        << text_of_findings(of_bytes);
    EXPECT_TRUE(same_pixels(rendered(of_file), rendered(of_bytes)));
}

TEST(OpenSceneOfBytes, ThatAreNoSceneIsAFinding) {
    for (const char* name : {"scenes/none.dae", "gltf/none.gltf", "gltf/none.glb"}) {
        OpenScene scene(of_assets(name));
        EXPECT_EQ(scene.open("no scene"), SceneError::Unreadable) << name;
        EXPECT_TRUE(scene.diagnostics().has_errors()) << name;
        EXPECT_FALSE(scene.is_built()) << name;
    }
}

TEST(OpenScene, SaysWhatStandsInTheWay) {
    OpenScene missing(of_assets("scenes/none.dae"));
    EXPECT_EQ(missing.open(), SceneError::Unreadable);
    SceneRequest request = of_assets("scenes/walker.dae");
    request.clip = "none";
    EXPECT_EQ(OpenScene(request).open(), SceneError::Request);
    request = of_assets("scenes/walker.dae");
    request.camera = "none";
    EXPECT_EQ(OpenScene(request).open(), SceneError::Request);
    request = of_assets("scenes/walker.dae");
    request.shaders = {{"*", "no_such_shader"}};
    EXPECT_EQ(OpenScene(request).open(), SceneError::Request);
}

TEST(OpenScene, ListsWhatItHas) {
    OpenScene scene(of_assets("scenes/walker.dae"));
    ASSERT_EQ(scene.open(), SceneError::None);
    const auto cameras = listed_cameras(scene.scene());
    ASSERT_FALSE(cameras.empty());
    EXPECT_EQ(std::ranges::count(cameras, true, &ListedCamera::chosen), 1);
    EXPECT_FALSE(listed_materials(scene.scene()).empty());
    EXPECT_FALSE(listed_shaders(scene.scene()).empty());
    EXPECT_FALSE(listed_library_shaders().empty());
    EXPECT_FALSE(listed_parameters(scene.scene()).empty());
    EXPECT_FALSE(listed_nodes(scene.scene()).empty());
}

// A scene built again has the pixels of one that was requested so.
TEST(OpenScene, IsBuiltAgainWithWhatWasSet) {
    SceneRequest request = of_assets("scenes/matte.dae");
    OpenScene set(request);
    ASSERT_EQ(set.open(), SceneError::None);
    const raytrace::Film before = rendered(set);
    EXPECT_TRUE(set.set_shader("*", "plastic"));
    EXPECT_TRUE(set.set_param("*.Kd", "0.25"));
    set.set_camera("top");
    ASSERT_EQ(set.build(), SceneError::None) << text_of_findings(set);
    const raytrace::Film after = rendered(set);
    EXPECT_FALSE(same_pixels(before, after));

    request.shaders = {{"*", "plastic"}};
    request.params = {{"*.Kd", "0.25"}};
    request.camera = "top";
    OpenScene requested(request);
    ASSERT_EQ(requested.open(), SceneError::None) << text_of_findings(requested);
    EXPECT_TRUE(same_pixels(after, rendered(requested)));
    EXPECT_FALSE(requested.set_param("*.none", "1"));
    EXPECT_TRUE(requested.diagnostics().has_errors());
}

const char* const kSays = R"(surface says() { Oi = 1; Ci = 1; printf("seen\n"); })";

// What shaders print goes where the request says, and nowhere else.
TEST(OpenScene, HearsWhatShadersPrint) {
    const std::string shader = testing::TempDir() + "says.sl";
    std::ofstream(shader) << kSays;
    SceneRequest request = of_assets("scenes/matte.dae");
    request.shaders = {{"*", shader}};
    testing::internal::CaptureStdout();
    OpenScene silent(request);
    ASSERT_EQ(silent.open(), SceneError::None) << text_of_findings(silent);
    rendered(silent);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    std::string heard;
    request.print = [&](std::string_view text) { heard += text; };
    OpenScene scene(request);
    ASSERT_EQ(scene.open(), SceneError::None);
    rendered(scene);
    EXPECT_TRUE(heard.starts_with("seen\nseen\n"));
}

// A check of ourselves that fails within a frame ends the frame; the scene goes on.
TEST(OpenScene, AFailedCheckIsAFinding) {
    const std::string shader = testing::TempDir() + "says.sl";
    std::ofstream(shader) << kSays;
    SceneRequest request = of_assets("scenes/matte.dae");
    request.shaders = {{"*", shader}};
    bool fails = true;
    request.print = [&](std::string_view) { CHECK(!fails); };
    OpenScene scene(request);
    ASSERT_EQ(scene.open(), SceneError::None);
    raytrace::Film film;
    EXPECT_FALSE(scene.render(0, film));
    const std::string found = text_of_findings(scene);
    EXPECT_NE(found.find("open_scene_test.cpp"), std::string::npos) << found;
    EXPECT_NE(found.find("CHECK failed: !fails [INTERNAL_CHECK]"), std::string::npos) << found;
    fails = false;
    EXPECT_TRUE(scene.render(0, film));
}

// The same on the threads that shade, behind the boundaries of tasks and services.
TEST(OpenScene, ACheckThatFailsWhileShadingIsAFindingToo) {
    class Fails : public KernelProbe {
      public:
        void run(const jit::KernelCall& call) override {
            call.run();
            CHECK_EQ(call.count, 0u);
        }
    } fails;
    set_thread_count(2);
    OpenScene scene(of_assets("scenes/matte.dae"));
    ASSERT_EQ(scene.open(), SceneError::None);
    const raytrace::Film whole = rendered(scene);
    probe_kernels(&fails);
    raytrace::Film film;
    EXPECT_FALSE(scene.render(0.5, film));
    probe_kernels(nullptr);
    EXPECT_NE(text_of_findings(scene).find("call.count == 0u"), std::string::npos)
        << text_of_findings(scene);
    EXPECT_TRUE(same_pixels(whole, rendered(scene)));
    set_thread_count(1);
}

TEST(OpenScene, APoseDependsOnItsTimeAlone) {
    OpenScene scene(of_assets("scenes/walker.dae"));
    ASSERT_EQ(scene.open(), SceneError::None);
    const raytrace::Film first = rendered(scene, 0.25);
    EXPECT_TRUE(scene.pose(0.75));
    EXPECT_FALSE(same_pixels(first, rendered(scene, 0.75)));
    EXPECT_TRUE(same_pixels(first, rendered(scene, 0.25)));
}

TEST(OpenScene, WithoutItsSourceIsBuiltOnce) {
    OpenScene scene(of_assets("scenes/matte.dae"), OpenScene::Keep::Nothing);
    ASSERT_EQ(scene.open(), SceneError::None);
    EXPECT_FALSE(scene.imported());
    EXPECT_FALSE(scene.set_param("*.Kd", "1"));
    EXPECT_EQ(scene.build(), SceneError::Unreadable);
    raytrace::Film film;
    EXPECT_FALSE(scene.render(0, film));
    EXPECT_FALSE(scene.pose(0));
}

}  // namespace
}  // namespace kinora
