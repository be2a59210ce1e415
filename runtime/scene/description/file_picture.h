// runtime/scene/description/file_picture.h: the picture that a scene file asks for, where its
// format says more than a camera.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kinora {

// How a display's numbers become whole ones: round(one * v + dither), within [low, high].
struct Quantization {
    double one = 255, low = 0, high = 255, dither = 0.5;  // one = 0: they stay floats
};

// A picture file that the scene writes.
struct FileDisplay {
    std::string name, type, mode;  // "out.tif", "file", "rgba"
    bool added = false;            // besides those before it
    Quantization quantization;
};

struct FilePicture {
    int number = 0;                 // of the frame, as the file counts
    int width = 640, height = 480;  // pixels that are made: those of the crop window
    int full_width = 640, full_height = 480;
    int left = 0, top = 0;  // of the crop window in the full picture
    double pixel_aspect = 1;
    int samples = 0;     // of a pixel; 0: the file does not say
    std::string filter;  // "gaussian"; "": the file does not say
    double filter_width = 2;
    double gain = 1, gamma = 1;  // (gain * colour) ^ (1 / gamma)
    std::vector<FileDisplay> displays;
};

}  // namespace kinora
