// runtime/play/display.h: a film to what a screen shows.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/images/image_io.h"
#include "runtime/play/picture.h"
#include "runtime/play/state.h"

namespace kinora {

struct DisplaySettings {
    ToneCurve tone = ToneCurve::Plain;
    std::string aov;  // a parameter of surfaces, or "depth", "Ng", "surface"; "" the picture
    bool false_color = false;
    ColorEncoding encoding = ColorEncoding::Srgb;
    std::shared_ptr<const Picture> kept;  // shown left of `wipe_at`, if of the same size
    double wipe_at = 0.5;

    bool operator==(const DisplaySettings&) const = default;
};

// Whether what is to be shown is made of the guide.
bool shows_guide(const std::string& aov);
// All that `aov` takes: "" first, the film's own, then those of the guide.
std::vector<std::string> shown_names(const std::vector<raytrace::AovPlane>& planes);

// Fills `out`, RGBA of the film's size. Plain and without AOV: to_8_bit, the bytes of a PNG.
void display(const raytrace::Film& film, const PictureGuide& guide, const DisplaySettings& settings,
             std::vector<uint8_t>& out);

// The bytes of to_8_bit, sooner and on all threads.
void fast_8_bit(const raytrace::Film& film, ColorEncoding encoding, std::vector<uint8_t>& out);

// Blue over green and yellow to red for 0 .. 1; white above, black below.
vec3 false_color(float value);

}  // namespace kinora
