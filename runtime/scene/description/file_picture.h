// runtime/scene/description/file_picture.h: the picture that a scene file asks for, where its
// format says more than a camera.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora {

// How a display's numbers become whole ones: 0 becomes `zero`, 1 becomes `one`, and what is outside
// of [low, high] its nearer end.
struct Quantization {
    double one = 255, low = 0, high = 255;
    double zero = 0;

    // Else numbers stay as they are.
    bool is_whole() const { return one != zero; }
};

// (gain * colour) ^ (1 / gamma).
struct Exposure {
    double gain = 1, gamma = 1;
};

// A picture file that the scene writes.
struct FileDisplay {
    std::string name, type, mode;              // "out.tif", "file", "rgba"
    std::optional<Quantization> quantization;  // nothing: 0 to 1 become 0 to 255
    std::optional<Exposure> exposure;          // instead of the picture's
    Location where;
};

// What a display shows, by its mode: "rgba", "rgbaz", "az", else an output of surfaces.
struct DisplayContent {
    bool color = false, alpha = false, depth = false;
    std::string variable;  // "N"; "" where one of the three is set

    bool is_picture() const { return color || alpha; }
};
DisplayContent content_of(const FileDisplay& display);

// What a display shows of an earlier picture of the file, by the order in the file, from 0.
struct MapPicture {
    int world = 0;
    std::string display;
    auto operator<=>(const MapPicture&) const = default;
};

struct FilePicture {
    int number = 0;                 // of the frame, as the file counts
    int width = 640, height = 480;  // pixels that are made: those of the crop window
    int full_width = 640, full_height = 480;
    int left = 0, top = 0;  // of the crop window in the full picture
    double pixel_aspect = 1;
    int samples = 0;                             // of a pixel; 0: the file does not say
    std::string filter;                          // "gaussian"; "": the file does not say
    double filter_width = 2, filter_height = 2;  // pixels
    // Of a filter that is none of ours: as raytrace::FilterGrid takes it.
    std::vector<float> filter_values;
    Exposure exposure;
    std::vector<FileDisplay> displays;
    // That the maps are made of which its shaders were given. Where the file was read for its
    // numbers alone, of all maps made so far.
    std::vector<MapPicture> map_pictures;
};

}  // namespace kinora
