// runtime/programs/play/raster/raster.h: draws Dear ImGui's draw lists into an RGBA picture in
// memory, as a GPU would with linear filtering and ImGui's blending.
//
// Coordinates are rounded to 1/256 pixel. A pixel belongs to a triangle if its centre does; a
// centre on an edge belongs to the triangle right of it or below it, so that triangles that share
// an edge never draw a pixel twice. The portable and the AVX2 kernels give the same bits.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>
#include <vector>

namespace kinora::play {

enum class TexelFormat {
    Alpha8,  // white with this alpha: fonts
    Rgba8,   // straight alpha
};

// What an ImTextureID points to.
struct Texture {
    const uint8_t* texels = nullptr;
    int width = 0, height = 0;
    TexelFormat format = TexelFormat::Rgba8;
    bool smooth = true;   // linear filtering; else the nearest texel
    bool opaque = false;  // every alpha is 255: rectangles without scale are copied
};

inline ImTextureID texture_id(const Texture* texture) {
    return const_cast<Texture*>(texture);
}

struct Target {
    uint32_t* pixels = nullptr;  // bytes r g b a
    int width = 0, height = 0;
    int stride = 0;  // pixels from one row to the next
};

// `kernel` is one of span_kernels(), or null for the fastest here.
void draw(const ImDrawData& data, const Target& target, const char* kernel = nullptr);

// Names of the kernels that this CPU runs, the fastest first.
std::vector<std::string> span_kernels();

}  // namespace kinora::play
