// tests/runtime/scene/images/texture_oiio_test.cpp: the sampler against OpenImageIO's
// TextureSystem.
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/runtime/scene/images/texture_lookup.h"

namespace kinora {
namespace {

// A float image as a file for OpenImageIO; removed with the object.
struct ImageFile {
    std::string path;
    ImageFile(const TextureImage& image, const char* name)
        : path((std::filesystem::temp_directory_path() /
                ("kinora_oiio_" + std::to_string(getpid()) + name + ".tif"))
                   .string()) {
        auto output = OIIO::ImageOutput::create(path);
        OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::FLOAT);
        spec.attribute("oiio:UnassociatedAlpha", 0);
        output->open(path, spec);
        output->write_image(OIIO::TypeDesc::FLOAT, image.floats.data());
        output->close();
    }
    ~ImageFile() { std::filesystem::remove(path); }
};

// The shared one, never destroyed: 2.4.7 deletes it with another type than it made it with.
OIIO::TextureSystem* texture_system() {
    OIIO::TextureSystem* system = OIIO::TextureSystem::create(true);
    system->attribute("automip", 1);
    return system;
}

TEST(AgainstOpenImageIO, BilinearLookupsAgree) {
    TextureImage image = float_image(48, 20);
    TexturePyramid pyramid(image, false);
    ImageFile file(image, "noise");
    OIIO::TextureSystem* oiio = texture_system();
    const std::pair<TextureWrap, OIIO::TextureOpt::Wrap> wraps[] = {
        {TextureWrap::Wrap, OIIO::TextureOpt::WrapPeriodic},
        {TextureWrap::Mirror, OIIO::TextureOpt::WrapMirror},
        {TextureWrap::Clamp, OIIO::TextureOpt::WrapClamp},
        {TextureWrap::Border, OIIO::TextureOpt::WrapBlack},
    };
    std::mt19937 random(11);
    std::uniform_real_distribution<float> place(-1.5f, 2.5f);
    for (auto [ours, theirs] : wraps) {
        TextureName modes;
        modes.wrap_s = modes.wrap_t = ours;
        OIIO::TextureOpt options;
        options.swrap = options.twrap = theirs;
        options.interpmode = OIIO::TextureOpt::InterpBilinear;
        options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
        for (int k = 0; k < 500; ++k) {
            TextureQuery q;
            q.s = place(random);
            q.t = place(random);
            Rgba got = look_up(pyramid, modes, TextureFilter::Bilinear, q);
            Rgba want{};
            ASSERT_TRUE(oiio->texture(OIIO::ustring(file.path), options, q.s, 1 - q.t, 0, 0, 0, 0,
                                      4, want.data()))
                << oiio->geterror();
            for (size_t c = 0; c < 4; ++c)
                ASSERT_NEAR(got[c], want[c], 3e-4) << int(ours) << " at " << q.s << " " << q.t;
        }
    }
}

// Isotropic footprints of one to sixteen texels on a smooth image: both are within their own
// filter's error of the truth.
TEST(AgainstOpenImageIO, TrilinearLookupsAgreeOnSmoothImages) {
    TextureImage image;
    image.width = image.height = 128;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x)
            image.floats.insert(image.floats.end(),
                                {0.5f + 0.4f * std::sin(float(x) * 0.0490874f),
                                 0.5f + 0.4f * std::cos(float(y) * 0.0981748f), 0.5f, 1.0f});
    TexturePyramid pyramid(image, false);
    ImageFile file(image, "waves");
    OIIO::TextureSystem* oiio = texture_system();
    OIIO::TextureOpt options;
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    options.mipmode = OIIO::TextureOpt::MipModeTrilinear;
    std::mt19937 random(13);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int k = 0; k < 500; ++k) {
        TextureQuery q;
        q.s = uniform(random);
        q.t = uniform(random);
        float width = (1 + 15 * uniform(random)) / 128;
        q.dsdx = q.dtdy = width;
        Rgba got = look_up(pyramid, TextureName(), TextureFilter::Trilinear, q);
        Rgba want{};
        ASSERT_TRUE(oiio->texture(OIIO::ustring(file.path), options, q.s, 1 - q.t, width, 0, 0,
                                  -width, 4, want.data()))
            << oiio->geterror();
        for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(got[c], want[c], 0.02);
    }
}

// Colour under alpha 0 stays, 16 bits stay 16 bits, grey spreads to r g b.
TEST(ReadTextureImage, KeepsWhatOtherFormatsHold) {
    struct Row {
        const char* extension;
        OIIO::TypeDesc::BASETYPE type;
        int channels;
        float tolerance;
        bool encoded;
    };
    const Row rows[] = {
        {"tga", OIIO::TypeDesc::UINT8, 4, 0.51f / 255, true},
        {"tif", OIIO::TypeDesc::UINT8, 4, 0.51f / 255, true},
        {"bmp", OIIO::TypeDesc::UINT8, 3, 0.51f / 255, true},
        {"png", OIIO::TypeDesc::UINT8, 4, 0.51f / 255, true},
        {"png", OIIO::TypeDesc::UINT16, 4, 0.51f / 65535, true},
        {"png", OIIO::TypeDesc::UINT16, 1, 0.51f / 65535, true},
        {"jpg", OIIO::TypeDesc::UINT8, 1, 0.08f, true},
        {"exr", OIIO::TypeDesc::FLOAT, 3, 0, false},
        {"exr", OIIO::TypeDesc::HALF, 4, 0.0005f, false},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(std::string(row.extension) + " " + std::to_string(row.channels));
        constexpr int kWidth = 9, kHeight = 6;
        std::vector<float> pixels;
        for (int i = 0; i < kWidth * kHeight; ++i)
            for (int c = 0; c < row.channels; ++c)
                pixels.push_back(c == 3 ? float(i % 3) / 2 : float(i + 3 * c) / 64);
        std::string path = (std::filesystem::temp_directory_path() /
                            ("kinora_read_" + std::to_string(getpid()) + "." + row.extension))
                               .string();
        auto output = OIIO::ImageOutput::create(path);
        OIIO::ImageSpec spec(kWidth, kHeight, row.channels, row.type);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        ASSERT_TRUE(output->open(path, spec));
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
        output->close();
        TextureImage image;
        EXPECT_EQ(read_texture_image(path, image), "");
        std::filesystem::remove(path);
        ASSERT_EQ(image.width, kWidth);
        ASSERT_EQ(image.height, kHeight);
        EXPECT_EQ(image.encoded, row.encoded);
        for (int i = 0; i < kWidth * kHeight; ++i)
            for (int c = 0; c < 4; ++c) {
                size_t at = size_t(i * 4 + c);
                float got = image.is_float() ? image.floats[at] : float(image.bytes[at]) / 255;
                int from = c < row.channels ? c : c == 3 ? -1 : 0;
                float want = from < 0 ? 1 : pixels[size_t(i * row.channels + from)];
                ASSERT_NEAR(got, want, row.tolerance) << i << " " << c;
            }
    }
}

}  // namespace
}  // namespace kinora
