// tests/runtime/texture_oiio_test.cpp: the sampler against OpenImageIO's TextureSystem.
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "texture_lookup.h"

namespace kinora {
namespace {

// A float image as a file for OpenImageIO; removed with the object.
struct ImageFile {
    std::string path = (std::filesystem::temp_directory_path() /
                        ("kinora_oiio_" + std::to_string(getpid()) + ".tif"))
                           .string();
    explicit ImageFile(const TextureImage& image) {
        auto output = OIIO::ImageOutput::create(path);
        OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::FLOAT);
        spec.attribute("oiio:UnassociatedAlpha", 0);
        output->open(path, spec);
        output->write_image(OIIO::TypeDesc::FLOAT, image.floats.data());
        output->close();
    }
    ~ImageFile() { std::filesystem::remove(path); }
};

struct System {
    OIIO::TextureSystem* system = OIIO::TextureSystem::create(false);
    System() { system->attribute("automip", 1); }
    ~System() { OIIO::TextureSystem::destroy(system); }
};

TEST(AgainstOpenImageIO, BilinearLookupsAgree) {
    TextureImage image = float_image(48, 20);
    TexturePyramid pyramid(image, false);
    ImageFile file(image);
    System oiio;
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
            ASSERT_TRUE(oiio.system->texture(OIIO::ustring(file.path), options, q.s, 1 - q.t, 0, 0,
                                             0, 0, 4, want.data()))
                << oiio.system->geterror();
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
    ImageFile file(image);
    System oiio;
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
        ASSERT_TRUE(oiio.system->texture(OIIO::ustring(file.path), options, q.s, 1 - q.t, width, 0,
                                         0, -width, 4, want.data()))
            << oiio.system->geterror();
        for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(got[c], want[c], 0.02);
    }
}

}  // namespace
}  // namespace kinora
