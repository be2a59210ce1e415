// runtime/scene/tessellate/fineness_p.h: how many segments the patches of a surface get.
#pragma once

#include <vector>

#include "runtime/scene/tessellate/sheet_p.h"
#include "runtime/scene/tessellate/tessellate.h"

namespace kinora::tessellation {

// What slides along the surface moves textures, not outlines: so many times the error is allowed.
inline constexpr double kSlide = 4;

// Pixels of lengths in camera space.
class PixelMeasure {
  public:
    // `size`: the largest of the surface's bounds, for when there is no picture.
    PixelMeasure(const PictureScale& scale, FunctionRef<double()> size);
    dvec3 vector(dvec3 v) const { return linear_ * v; }
    dvec3 place(dvec3 p) const { return linear_ * p + offset_; }
    // Pixels of a unit, in any direction, at a place of camera space.
    double at(dvec3 p_camera) const;

  private:
    dmat3 linear_{1.0};
    dvec3 offset_{0.0};
    bool orthographic_ = true;
    double pixels_ = 1, near_ = 1e-3;
};

// By the places that show how patches bend.
double largest_extent(const Sheet& sheet);

struct Fineness {
    std::vector<uint32_t> u, v;  // segments of each column and row of patches
    uint32_t merged = 1;  // patches that one segment covers, where single ones are over the limit
    double error = 0;     // pixels
};

Fineness choose_fineness(const Sheet& sheet, const PixelMeasure& measure,
                         const TessellationLimits& limits);

std::vector<Line> make_lines(const std::vector<uint32_t>& segments, uint32_t merged);

// Pixels between the surface and its triangles: the most of each column and row.
struct Deviation {
    std::vector<double> u, v;
    double most() const;
};
Deviation measure_deviation(const Sheet& sheet, const PixelMeasure& measure,
                            const Fineness& fineness);

}  // namespace kinora::tessellation
