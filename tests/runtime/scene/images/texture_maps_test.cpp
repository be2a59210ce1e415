// tests/runtime/scene/images/texture_maps_test.cpp: facts of images, depth maps, and cubes of six
// faces against OpenEXR's own mapping.
#include <Imath/ImathVec.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "rsl/model/renderer_services.h"
#include "runtime/base/math.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/images/texture_store.h"

namespace kinora {
namespace {

constexpr int kLanes = jit::kMaxLanes;

std::string temp_path(const std::string& name) {
    return (std::filesystem::temp_directory_path() /
            ("kinora_maps_" + std::to_string(getpid()) + name))
        .string();
}

// Writes a float EXR; removed with the object.
struct Exr {
    std::string path;
    Exr(const char* name, OIIO::ImageSpec spec, const std::vector<float>& pixels)
        : path(temp_path(name)) {
        auto output = OIIO::ImageOutput::create(path);
        EXPECT_TRUE(output->open(path, spec));
        EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
        output->close();
    }
    ~Exr() { std::filesystem::remove(path); }
    int32_t name() const { return rsl::intern(path); }
};

// One call of a service, the same arguments in all lanes.
std::vector<float> call(void (*service)(const jit::ServiceCall&), std::vector<float> values,
                        int results) {
    alignas(64) std::vector<float> args, out(size_t(results * kLanes), -77);
    for (float x : values) args.insert(args.end(), kLanes, x);
    jit::ServiceCall c{};
    c.args = args.data();
    c.results = out.data();
    c.mask = 1u << 3;
    c.lanes = kLanes;
    service(c);
    std::vector<float> lane;
    for (int k = 0; k < results; ++k) lane.push_back(out[size_t(k * kLanes + 3)]);
    return lane;
}

std::vector<float> info(int32_t name, const char* field) {
    auto service = [](const jit::ServiceCall& c) {
        lookup_texture_info(c, TextureStore::process());
    };
    return call(service, {jit::float_of(name), jit::float_of(rsl::intern(field))}, 17);
}

// The eye at z = -5 looking along +z with a view of 90 degrees; row vectors.
const float kCamera[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1};
const float kScreen[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 5, 5};

OIIO::ImageSpec depth_spec(int size) {
    OIIO::ImageSpec spec(size, size, 1, OIIO::TypeDesc::FLOAT);
    spec.attribute("worldtocamera", OIIO::TypeDesc::TypeMatrix, kCamera);
    spec.attribute("worldtoscreen", OIIO::TypeDesc::TypeMatrix, kScreen);
    spec.attribute("textureformat", "Shadow");
    return spec;
}

TEST(TextureInfo, KnowsWhatTheFileSays) {
    Exr image("info.exr", depth_spec(8), std::vector<float>(64, 3.0f));
    auto resolution = info(image.name(), "resolution");
    EXPECT_EQ(jit::bits_of(resolution[0]), 2);
    EXPECT_EQ(resolution[1], 8);
    EXPECT_EQ(resolution[2], 8);
    EXPECT_EQ(info(image.name(), "channels")[1], 1);
    auto type = info(image.name(), "type");
    EXPECT_EQ(jit::bits_of(type[0]), -1);
    EXPECT_EQ(rsl::interned(jit::bits_of(type[1])), "shadow");
    auto matrix = info(image.name(), "viewingmatrix");
    EXPECT_EQ(jit::bits_of(matrix[0]), 16);
    for (size_t k = 0; k < 16; ++k) EXPECT_EQ(matrix[1 + k], kCamera[k]) << k;
    EXPECT_EQ(jit::bits_of(info(image.name(), "no such field")[0]), 0);
    EXPECT_EQ(jit::bits_of(info(rsl::intern("/no/such/file.exr"), "resolution")[0]), 0);
    EXPECT_EQ(info(rsl::intern("/no/such/file.exr"), "exists")[1], 0);
}

TEST(TextureInfo, ChannelsArePngsOwn) {
    for (int channels : {1, 2, 3, 4}) {
        Exr image((std::to_string(channels) + ".png").c_str(),
                  OIIO::ImageSpec(4, 4, channels, OIIO::TypeDesc::UINT8),
                  std::vector<float>(size_t(16 * channels), 0.5f));
        EXPECT_EQ(info(image.name(), "channels")[1], float(channels));
    }
}

float shadow_at(int32_t name, vec3 p, float bias = -1, float blur = 0, float samples = 16) {
    static dmat4 identity(1);
    auto service = [](const jit::ServiceCall& c) {
        lookup_shadow(c, identity, TextureStore::process());
    };
    return call(service,
                {jit::float_of(name), p.x, p.y, p.z, 0, 0, 0, 0, 0, 0, bias, blur, samples}, 3)[0];
}

// A blocker at depth 4 (z = -1) covers the left half of the map.
TEST(ShadowMap, HidesWhatLiesBehindWhatItSaw) {
    constexpr int kSize = 64;
    std::vector<float> depth;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) depth.push_back(x < kSize / 2 ? 4.0f : 1e30f);
    Exr map("shadow.exr", depth_spec(kSize), depth);
    EXPECT_EQ(shadow_at(map.name(), {-1, 0, 0}), 1);     // behind the blocker
    EXPECT_EQ(shadow_at(map.name(), {1, 0, 0}), 0);      // beside it
    EXPECT_EQ(shadow_at(map.name(), {-1, 0, -2}), 0);    // before it
    EXPECT_EQ(shadow_at(map.name(), {-1, 0, -1}), 0);    // on it: the default bias
    EXPECT_EQ(shadow_at(map.name(), {-1, 0, 0}, 3), 0);  // within a bias of 3
    EXPECT_EQ(shadow_at(map.name(), {-40, 0, 0}), 0);    // beyond the map
    EXPECT_EQ(shadow_at(map.name(), {-1, 0, -9}), 0);    // behind the eye
    EXPECT_NEAR(shadow_at(map.name(), {0, 0, 0}, -1, 0.2f, 64), 0.5f, 0.1f);  // across its edge
    Exr plain("plain.exr", OIIO::ImageSpec(4, 4, 3, OIIO::TypeDesc::FLOAT),
              std::vector<float>(48, 0.1f));
    EXPECT_EQ(shadow_at(plain.name(), {-1, 0, 0}), 0);  // no depth map
}

// Rows of the map from the top: what is low in y is in the lower rows.
TEST(ShadowMap, HasItsTopWhereYIsUp) {
    std::vector<float> depth;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) depth.push_back(y < 16 ? 4.0f : 1e30f);
    Exr map("top.exr", depth_spec(32), depth);
    EXPECT_EQ(shadow_at(map.name(), {0, 2, 0}), 1);
    EXPECT_EQ(shadow_at(map.name(), {0, -2, 0}), 0);
}

TEST(EnvironmentMap, ADirectionOfNoLengthGivesTheFillColour) {
    Exr map("plain_environment.exr", OIIO::ImageSpec(8, 4, 3, OIIO::TypeDesc::FLOAT),
            std::vector<float>(96, 0.75f));
    auto service = [](const jit::ServiceCall& c) {
        lookup_environment(c, TextureStore::process());
    };
    auto looked = [&](vec3 d) {
        return call(service,
                    {jit::float_of(map.name()), 0, d.x, d.y, d.z, 0, 0, 0, 0, 0, 0, 0, 0.25f}, 4);
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NEAR(looked({0, 1, 0})[0], 0.75f, 1e-3f);
    for (vec3 d : {vec3(0.0f), vec3(nan, 0, 1), vec3(nan)})
        for (int k = 0; k < 3; ++k) EXPECT_EQ(looked(d)[size_t(k)], 0.25f);
}

TEST(EnvironmentCube, LooksWhereOpenExrWould) {
    constexpr int kSide = 16;
    OIIO::ImageSpec spec(kSide, 6 * kSide, 3, OIIO::TypeDesc::FLOAT);
    std::vector<float> pixels;
    for (int y = 0; y < 6 * kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            pixels.insert(pixels.end(),
                          {float(x) / kSide, float(y % kSide) / kSide, float(y / kSide)});
    Exr map("cube.exr", spec, pixels);
    Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(kSide - 1, 6 * kSide - 1));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (int k = 0; k < 400; ++k) {
        Imath::V3f d(uniform(random), uniform(random), uniform(random));
        Imf::CubeMapFace face;
        Imath::V2f in_face;
        Imf::CubeMap::faceAndPixelPosition(d, window, face, in_face);
        Imath::V2f at = Imf::CubeMap::pixelPosition(face, window, in_face);
        auto service = [](const jit::ServiceCall& c) {
            lookup_environment(c, TextureStore::process());
        };
        auto got =
            call(service, {jit::float_of(map.name()), 0, d.x, d.y, d.z, 0, 0, 0, 0, 0, 0, 0, 0}, 4);
        EXPECT_NEAR(got[2], float(face), 1e-3f);
        EXPECT_NEAR(got[0], at.x / kSide, 2e-3f) << "face " << face;
        EXPECT_NEAR(got[1], (at.y - float(face) * kSide) / kSide, 2e-3f) << "face " << face;
    }
}

// What a film holds reaches the file: colours as halves, planes as floats.
TEST(WriteImage, WhatIsFiniteStaysFiniteInAnExr) {
    raytrace::Film film(1, 1);
    film.add_aov("far", raytrace::AovFilter::Nearest);
    film.at(0, 0) = vec4(1e30f, 1e-30f, -1e30f, 1);
    film.aovs[0].values[0] = 1e30f;
    const std::string path = temp_path("extreme.exr");
    ASSERT_EQ(write_image(path, film, {}, {}), "");
    auto input = OIIO::ImageInput::open(path);
    ASSERT_TRUE(input);
    const OIIO::ImageSpec& spec = input->spec();
    std::vector<float> pixel(size_t(spec.nchannels));
    ASSERT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixel.data()));
    const std::pair<const char*, float> expected[] = {
        {"R", 65504}, {"G", 0}, {"B", -65504}, {"A", 1}, {"far", 1e30f}};
    for (auto [name, value] : expected)
        EXPECT_EQ(pixel.at(size_t(spec.channelindex(name))), value) << name;
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace kinora
