// rsl/model/color_matrices.h: the constants of color spaces, shared by lowering and reference.
#pragma once

namespace kinora::rsl {

// Row-major, on column vectors: out[i] = sum over j of m[i][j] * in[j].
using ColorMatrix = double[3][3];

// CIE XYZ for the primaries and white (D65) of ITU-R BT.709.
inline constexpr ColorMatrix kXyzFromRgb = {
    {0.412453, 0.357580, 0.180423}, {0.212671, 0.715160, 0.072169}, {0.019334, 0.119193, 0.950227}};
inline constexpr ColorMatrix kRgbFromXyz = {{3.240479, -1.537150, -0.498535},
                                            {-0.969256, 1.875991, 0.041556},
                                            {0.055648, -0.204043, 1.057311}};
// NTSC YIQ.
inline constexpr ColorMatrix kYiqFromRgb = {
    {0.299, 0.587, 0.114}, {0.596, -0.275, -0.321}, {0.212, -0.523, 0.311}};
inline constexpr ColorMatrix kRgbFromYiq = {
    {1, 0.956, 0.620}, {1, -0.272, -0.647}, {1, -1.108, 1.705}};

}  // namespace kinora::rsl
