// runtime/player/display.h: a film to what a screen shows.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/player/picture/picture.h"
#include "runtime/player/state.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

struct PixelStory;  // runtime/player/pixel/pixel_story.h

struct DisplaySettings {
    ToneCurve tone = ToneCurve::Plain;
    std::string aov;  // a parameter of surfaces, or a name of below; "" the picture
    bool false_color = false;
    ColorEncoding encoding = ColorEncoding::Srgb;
    std::shared_ptr<const Picture> kept;  // shown left of `wipe_at`, as large as the picture
    double wipe_at = 0.5;
    std::shared_ptr<const PixelStory> rays;  // drawn over the picture; for RenderLoop

    bool operator==(const DisplaySettings&) const = default;
};

// Whether what is to be shown is made of the guide: "depth", "Ng", "surface".
bool shows_guide(const std::string& aov);
// Or of the costs: "shading_ns", "rays", "lanes", "samples".
bool shows_costs(const std::string& aov);
// A number for each of the film's pixels: ns, rays or points a pixel, or the share of the lanes.
std::vector<float> cost_numbers(const PixelCosts& costs, const std::string& aov);
// All that `aov` takes: "" first, the film's own, then those of guide and costs.
std::vector<std::string> shown_names(const std::vector<raytrace::AovPlane>& planes);

// What the colors of such a picture stand for; nothing where they are no numbers.
std::optional<NumberScale> number_scale(const raytrace::Film& film, const PictureGuide& guide,
                                        const PixelCosts& costs, const DisplaySettings& settings);
// The numbers of an AOV at a place, in shares of the picture's width and height; none: "" or
// nothing there.
std::vector<float> shown_numbers(const Picture& picture, const std::string& aov, double x,
                                 double y);

// Fills `out`, RGBA of the film's size. Plain and without AOV: to_8_bit, the bytes of a PNG.
void display(const raytrace::Film& film, const PictureGuide& guide, const PixelCosts& costs,
             const DisplaySettings& settings, std::vector<uint8_t>& out);

// Whether a film's colors are shown as they are: by shown_bytes(), and show_kept() over them.
bool is_plain(const DisplaySettings& settings);
void show_kept(const DisplaySettings& settings, int width, int height, std::vector<uint8_t>& out);

// Blue over green and yellow to red for 0 .. 1; white above, black below.
vec3 false_color(float value);

}  // namespace kinora
