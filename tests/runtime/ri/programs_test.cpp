// tests/runtime/ri/programs_test.cpp: C programs make the pictures that the RIB they write makes.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/kinora/kinora.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct Program {
    const char* name;
    int pictures;
};

class RiPrograms : public testing::TestWithParam<Program> {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / (std::string("ri_") + GetParam().name);
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    // Its exit code; it runs in the folder.
    int run(const std::string& rib, const std::string& picture, const char* environment = "") {
        std::string command = "cd " + folder_.string() + " && " + environment + " " +
                              KINORA_RI_PROGRAMS + GetParam().name + " '" + rib + "' " + picture;
        int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    // What is made of a world of a file, or of its bytes.
    void render(const std::string& rib, int world, int number, const std::string& picture,
                bool bytes) {
        SceneRequest request;
        request.scene = rib;
        request.world = world;
        request.quality = *find_quality(kDefaultQuality);
        OpenScene scene(request);
        const std::string text = bytes ? content(rib) : "";
        ASSERT_EQ(bytes ? scene.open(text) : scene.open(), SceneError::None);
        scene.ready_frames();
        scene.settings().integrator.seed = frame_seed(request, number);
        raytrace::Film film;
        ASSERT_TRUE(scene.render(scene.scene().options.start_time, film));
        ASSERT_EQ(write_image(picture, film, encoding_of(request), {}), "");
    }

  private:
    fs::path folder_;
};

// The program's pictures also hold how they were made.
std::vector<uint8_t> pixels(const std::string& picture) {
    std::optional<Image8> image = read_png(picture);
    return image ? image->rgba : std::vector<uint8_t>();
}

bool has_several_colors(const std::string& picture) {
    std::optional<Image8> image = read_png(picture);
    if (!image) return false;
    std::set<uint32_t> colors;
    for (size_t i = 0; i + 3 < image->rgba.size(); i += 4)
        colors.insert(image->rgba[i] | image->rgba[i + 1] << 8u | image->rgba[i + 2] << 16u);
    return colors.size() > 5;
}

TEST_P(RiPrograms, MakeThePicturesOfTheirRib) {
    ASSERT_EQ(run("", "made"), 0);
    ASSERT_EQ(run("scene.rib", "none"), 0);
    std::vector<int> numbers = worlds_of(file("scene.rib"));
    ASSERT_EQ(numbers.size(), size_t(GetParam().pictures));
    for (size_t world = 0; world < numbers.size(); ++world) {
        std::string number = std::to_string(world + 1);
        std::string made = file("made" + number + ".png"), read = file("read" + number + ".png");
        EXPECT_TRUE(has_several_colors(made)) << made;
        for (bool bytes : {false, true}) {
            render(file("scene.rib"), int(world), numbers[world], read, bytes);
            EXPECT_EQ(content(made), content(read)) << made;
        }
    }
    std::string command = std::string(KINORA_RENDER) + " " + file("scene.rib") + " -o " +
                          file("rendered.####.png") + " >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    for (size_t world = 0; world < numbers.size(); ++world)
        EXPECT_EQ(pixels(file(fmt::format("rendered.{:04}.png", numbers[world]))),
                  pixels(file(fmt::format("made{}.png", world + 1))));
    EXPECT_FALSE(fs::exists(file("none1.png")));
}

TEST_P(RiPrograms, WriteTheSamePackedRib) {
    ASSERT_EQ(run("scene.rib", "a"), 0);
    ASSERT_EQ(run("scene.rib.gz", "a"), 0);
    std::string packed = content(file("scene.rib.gz"));
    ASSERT_TRUE(packed.starts_with("\x1f\x8b"));
    std::string unpack = "gzip -dc " + file("scene.rib.gz") + " > " + file("unpacked.rib");
    ASSERT_EQ(std::system(unpack.c_str()), 0);
    EXPECT_EQ(content(file("unpacked.rib")), content(file("scene.rib")));
}

std::string name_of(const testing::TestParamInfo<Program>& info) {
    return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Of, RiPrograms,
                         testing::Values(Program{"polygons", 2}, Program{"patches", 1},
                                         Program{"handlers", 1}, Program{"bulb", 1},
                                         Program{"window", 1}, Program{"teapot", 1}),
                         name_of);

}  // namespace
}  // namespace kinora
