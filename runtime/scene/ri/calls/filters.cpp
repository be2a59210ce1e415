// runtime/scene/ri/calls/filters.cpp: the pixel filters of ri.h, over distances up to half a width.
#include <cmath>
#include <numbers>

#include "runtime/scene/ri/calls/functions_p.h"

namespace {

// Mitchell and Netravali 1988 with B = C = 1/3, of |x| from 0 to 2.
float mitchell(float x) {
    x = std::abs(x);
    if (x >= 2) return 0;
    if (x < 1) return (21 * x * x * x - 36 * x * x + 16) / 18;
    return (-7 * x * x * x + 36 * x * x - 60 * x + 32) / 18;
}

float catmull_rom(float x) {
    x = std::abs(x);
    if (x >= 2) return 0;
    if (x < 1) return 0.5f * (2 - 5 * x * x + 3 * x * x * x);
    return 0.5f * (4 - 8 * x + 5 * x * x - x * x * x);
}

// A sinc under a window of one lobe of a cosine.
float windowed_sinc(float x, float width) {
    if (std::abs(x) > width / 2) return 0;
    float pi = std::numbers::pi_v<float>, a = pi * x;
    float window = std::cos(pi * x / width);
    return std::abs(a) < 1e-4f ? window : window * std::sin(a) / a;
}

}  // namespace

RtFloat RiBoxFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    return std::abs(x) <= xwidth / 2 && std::abs(y) <= ywidth / 2 ? 1.0f : 0.0f;
}

RtFloat RiTriangleFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    return std::max(1 - 2 * std::abs(x) / xwidth, 0.0f) *
           std::max(1 - 2 * std::abs(y) / ywidth, 0.0f);
}

RtFloat RiGaussianFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    float a = 2 * x / xwidth, b = 2 * y / ywidth;
    return std::exp(-2 * (a * a + b * b));
}

RtFloat RiCatmullRomFilter(RtFloat x, RtFloat y, RtFloat, RtFloat) {
    return catmull_rom(x) * catmull_rom(y);
}

RtFloat RiMitchellFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    return mitchell(4 * x / xwidth) * mitchell(4 * y / ywidth);
}

RtFloat RiSincFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    return windowed_sinc(x, xwidth) * windowed_sinc(y, ywidth);
}

RtFloat RiDiskFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    float a = 2 * x / xwidth, b = 2 * y / ywidth;
    return a * a + b * b <= 1 ? 1.0f : 0.0f;
}

// J1(2 pi r) / r, the Fourier transform of a disk, within the ellipse of the widths.
RtFloat RiBesselFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    float a = 2 * x / xwidth, b = 2 * y / ywidth;
    if (a * a + b * b > 1) return 0;
    float r = std::sqrt(x * x + y * y), pi = std::numbers::pi_v<float>;
    return r < 1e-4f ? pi : float(::j1(double(2 * pi * r))) / r;
}

namespace kinora::ri {
namespace {

struct FilterRow {
    RtFilterFunc function;
    const char* name;
};
constexpr FilterRow kFilters[] = {
    {RiBoxFilter, "box"},           {RiTriangleFilter, "triangle"},
    {RiGaussianFilter, "gaussian"}, {RiCatmullRomFilter, "catmull-rom"},
    {RiSincFilter, "sinc"},         {RiMitchellFilter, "mitchell"},
    {RiDiskFilter, "disk"},         {RiBesselFilter, "bessel"},
};

}  // namespace

Values filter_values(RtFilterFunc filter) {
    for (const FilterRow& row : kFilters)
        if (row.function == filter) return row.name;
    return reinterpret_cast<void (*)()>(filter);
}

RtFilterFunc filter_function(std::string_view name) {
    for (const FilterRow& row : kFilters)
        if (row.name == name) return row.function;
    return nullptr;
}

std::string filter_names() {
    std::string names;
    for (const FilterRow& row : kFilters)
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

}  // namespace kinora::ri
