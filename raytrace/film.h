// raytrace/film.h: the picture being made: colour with coverage, any number of AOVs, filters.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/math.h"

namespace kinora::raytrace {

struct FilterTable;  // raytrace/pixels/pixels.h

// What a non-finite shader result becomes.
enum class NanPolicy : uint8_t { Zero, Magenta, Keep };

// What a pixel keeps of its samples' numbers.
enum class AovFilter : uint8_t {
    Mean,     // mean over the pixel's samples; a sample that misses counts 0 ("premultiplied")
    Average,  // plain mean of the samples that hit
    Nearest,  // of the sample nearest to the pixel's centre, hit or not: for places and ids
    Least,    // the least of the samples that hit: for depths
    Most,     // the largest of the samples that hit
};
inline constexpr float kNoDepth = 1e38f;  // RI_INFINITY

// Who fills a plane.
enum class AovOrigin : uint8_t {
    Surface,   // SurfaceShading::shade
    Samples,   // the integrator: how many samples the pixel has
    Variance,  // the integrator: of the samples' colours, unbiased; 0 with one sample
    Light,     // SurfaceShading::shade and shade_misses: part of Ci, composited as Ci is
    Coverage,  // the integrator: twelve planes one behind the other, ids of surfaces and how much
               // of the pixel each covers, by that. SurfaceShading::shade gives the first its ids
    Other,     // the caller, when the film is done
};

// One float component of one AOV of the nearest surface whose Oi is not 0: "z", "N.x". A colour is
// three planes.
struct AovPlane {
    std::string name;
    AovFilter filter = AovFilter::Mean;
    std::vector<float> values = {};  // width * height, rows from the top
    bool in_file = true;             // false: for imagers and displays
    float background = 0;            // where the filter has no sample; Mean: always 0
    AovOrigin origin = AovOrigin::Surface;
    int component = 0;       // of the colour that a variance or light is of; of twelve
    std::string layer = {};  // the AOV that it is a channel of; "": one of its own
    bool half = false;       // in a file
    bool exact = false;      // not a digit may go in a file
};

// Linear, associated ("premultiplied") RGBA: alpha is coverage, the mean of Oi's components.
struct Film {
    int width = 0;
    int height = 0;
    int top = 0;             // a band begins at that row of its picture
    bool is_band = false;    // else the film is the whole picture
    std::vector<vec4> rgba;  // width * height, rows from the top
    std::vector<AovPlane> aovs;
    uint64_t non_finite = 0;  // shading results that were not finite, since clear()

    Film() = default;
    Film(int w, int h) { resize(w, h); }
    void resize(int w, int h);  // and clear: of a whole picture
    // The rows from `first` on of a picture, cleared. Pictures too large for memory are made so.
    void hold_band(int w, int first, int rows);
    AovPlane& add_aov(std::string name, AovFilter filter = AovFilter::Mean);
    void clear();  // all to 0; keeps memory and AOVs
    vec4& at(int x, int y) { return rgba[size_t(y) * size_t(width) + size_t(x)]; }
    const vec4& at(int x, int y) const { return rgba[size_t(y) * size_t(width) + size_t(x)]; }
};

// A pixel filter: a row. Samples are drawn with the filter's density instead of being weighted by
// it (filter importance sampling), so each sample belongs to one pixel, a tile needs no neighbour
// and the sum's order does not depend on tiles or threads. Densities must not be negative.
struct PixelFilter {
    const char* name;
    double width;                 // in pixels, the support is [-width/2, width/2]
    double (*density)(double x);  // along one axis, x in [-1, 1] over the support; any scale
};
std::span<const PixelFilter> pixel_filters();                 // "box", "triangle", "gaussian"
const PixelFilter* find_pixel_filter(std::string_view name);  // nullptr: no such row

// Turns numbers in [0,1) into filter offsets: the inverse of the filter's integral, tabulated.
class FilterSampler {
  public:
    explicit FilterSampler(const PixelFilter& filter, double width = 0);  // 0: the row's own
    double offset(double u) const;  // pixels from the pixel's centre, along one axis
    FilterTable table() const;

  private:
    std::vector<double> inverse_;
};

}  // namespace kinora::raytrace
