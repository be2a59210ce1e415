// runtime/base/images_module/images_module.cpp: image files through OpenImageIO.
#include "runtime/base/images_module/images_module.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

namespace {

int failed(KinoraImage& image, const std::string& why) {
    std::snprintf(image.error, sizeof image.error, "%s", why.c_str());
    return 1;
}

// Settings of the whole library: no threads of its own, nothing larger than we take.
bool set_limits(uint64_t max_pixels) {
    uint64_t bytes = max_pixels * 4 * sizeof(float);
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("limits:imagesize_MB", int(bytes >> 20));
    return true;
}

bool copy_matrix(const OIIO::ImageSpec& spec, const char* name, float* matrix) {
    const OIIO::ParamValue* value = spec.find_attribute(name, OIIO::TypeDesc::TypeMatrix);
    if (!value) return false;
    std::copy_n(static_cast<const float*>(value->data()), 16, matrix);
    return true;
}

// NDC runs from the upper left, 0 to 1; screen from the lower left, -1 to 1.
void screen_from_ndc(float* matrix) {
    for (int row = 0; row < 4; ++row) {
        float* m = matrix + 4 * row;
        m[0] = 2 * m[0] - m[3];
        m[1] = m[3] - 2 * m[1];
    }
}

void describe(const OIIO::ImageSpec& spec, KinoraImage& image) {
    std::string format = spec.get_string_attribute("textureformat");
    bool ndc = false;
    bool screen = copy_matrix(spec, "worldtoscreen", image.world_to_screen) ||
                  (ndc = copy_matrix(spec, "worldtoNDC", image.world_to_screen));
    if (ndc) screen_from_ndc(image.world_to_screen);
    image.has_matrices = screen && copy_matrix(spec, "worldtocamera", image.world_to_camera);
    image.file_channels = spec.nchannels;
    bool depth = format.find("Shadow") != std::string::npos;
    image.kind = depth ? 2 : format.find("Environment") != std::string::npos ? 1 : 0;
    if (image.kind == 0 && image.has_matrices && spec.nchannels == 1) image.kind = 2;
}

int decode(const char* path, uint64_t max_pixels, KinoraImage& image) {
    static const bool limited = set_limits(max_pixels);
    (void)limited;
    OIIO::ImageSpec wishes;
    wishes["oiio:UnassociatedAlpha"] = 1;
    auto input = OIIO::ImageInput::open(path, &wishes);
    if (!input) return failed(image, OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1)
        return failed(image, "it holds no flat picture");
    if (uint64_t(spec.width) * uint64_t(spec.height) > max_pixels)
        return failed(image, "it is too large, " + std::to_string(spec.width) + " x " +
                                 std::to_string(spec.height) + " pixels");
    describe(spec, image);
    bool bytes = spec.format == OIIO::TypeDesc::UINT8;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = std::min(spec.nchannels, 4);
    image.alpha_channel = spec.alpha_channel < image.channels ? spec.alpha_channel : -1;
    image.is_float = !bytes;
    image.encoded = !spec.format.is_floating_point();
    size_t samples = size_t(spec.width) * size_t(spec.height) * size_t(image.channels);
    std::unique_ptr<void, void (*)(void*)> pixels(
        std::malloc(samples * (bytes ? 1 : sizeof(float))), std::free);
    if (!pixels) return failed(image, "not enough memory");
    auto type = bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    if (!input->read_image(0, 0, 0, image.channels, type, pixels.get()))
        return failed(image, input->geterror());
    image.pixels = pixels.release();
    return 0;
}

}  // namespace

extern "C" int kinora_decode_image(const char* path, uint64_t max_pixels, KinoraImage* image) {
    *image = {};
    try {
        return decode(path, max_pixels, *image);
    } catch (const std::exception& error) {
        return failed(*image, error.what());
    } catch (...) {
        return failed(*image, "unknown error");
    }
}

extern "C" void kinora_free_image(KinoraImage* image) {
    std::free(image->pixels);
    image->pixels = nullptr;
}
