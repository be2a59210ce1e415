// jit/math/coefficients_p.h: constants of jit/math, made by scripts/math_coefficients.py.
// Polynomials are minimax in relative error (2^n below: largest error of the fit alone),
// lowest power first, rounded to float one by one with the rest refitted.
#pragma once

#include <cstdint>

namespace kinora::jit::math {

// sin r = r + r z p(z), |r| <= pi/4: 2^-27.9
inline constexpr float kSin[] = {-0.166666552f, 0.00833218824f, -0.000195180954f};
// cos r = 1 - z/2 + z^2 p(z), |r| <= pi/4: 2^-33.0
inline constexpr float kCos[] = {0.0416666456f, -0.00138873095f, 2.44323273e-05f};
// sin r = r + r z p(z), |r| <= pi/2: 2^-27.3
inline constexpr float kSinWide[] = {-0.166666597f, 0.00833306927f, -0.000198097739f,
                                     2.60608181e-06f};
// tan r = r + r z p(z), |r| <= pi/4: 2^-25.7
inline constexpr float kTan[] = {0.333331555f,  0.133388355f,   0.0534082018f,
                                 0.0244413912f, 0.00310148229f, 0.00939652603f};
// e^r = 1 + r + r^2 p(r), |r| <= ln 2 / 2: 2^-27.8
inline constexpr float kExp[] = {0.49999994f, 0.166665196f, 0.0416683927f, 0.00836877991f,
                                 0.001381448f};
// e^r = 1 + r p(r), |r| <= ln 2 / 2: 2^-23.3
inline constexpr float kExpFast[] = {0.999999702f, 0.499991447f, 0.166676402f, 0.0418983884f,
                                     0.00829022005f};
// 2^r = 1 + r ln 2 + r^2 p(r), |r| <= 1/2: 2^-27.9
inline constexpr float kExp2[] = {0.240226477f, 0.055503618f, 0.00961852912f, 0.00133903872f,
                                  0.000153208457f};
// 2^r = 1 + r p(r), |r| <= 1/2: 2^-23.1
inline constexpr float kExp2Fast[] = {0.693147004f, 0.240222394f, 0.0555073619f, 0.00967172533f,
                                      0.00132644398f};
// ln(1+f) = f - f^2/2 + f^3 p(f), sqrt(1/2) <= 1+f <= sqrt 2: 2^-28.2
inline constexpr float kLog[] = {0.333333135f,  -0.250000089f, 0.200021192f,
                                 -0.166679963f, 0.142195538f,  -0.1240559f,
                                 0.118881531f,  -0.116756313f, 0.067466259f};
// ln(1+f) = f + f^2 p(f): 2^-24.8
inline constexpr float kLogFast[] = {-0.499999911f, 0.333339512f, -0.250017554f, 0.199620739f,
                                     -0.16570507f,  0.149179682f, -0.143075198f, 0.087348327f};
// log2(1+f) = f p(f): 2^-24.4
inline constexpr float kLog2Fast[] = {1.44269502f,   -0.721347332f, 0.480910629f,
                                      -0.360703677f, 0.287916213f,  -0.238945112f,
                                      0.215716377f,  -0.207268223f, 0.125833258f};
// log2((1+s)/(1-s)) = 2/ln 2 (s + s^3/3 + s^5 p(s^2)), |s| <= 0.1716: 2^-42.3
inline constexpr float kLog2Pow[] = {0.577077985f, 0.412205935f, 0.320011795f, 0.281711966f};
// atan q = q + q z p(z), |q| <= tan(pi/8): 2^-30.4
inline constexpr float kAtan[] = {-0.333333164f, 0.199985266f, -0.142443463f, 0.105987519f,
                                  -0.0608882755f};
// the same, shorter: 2^-25.5
inline constexpr float kAtanFast[] = {-0.333329469f, 0.199776143f, -0.138765529f, 0.080498144f};
// asin x = x + x z p(z), |x| <= 1/2: 2^-30.9
inline constexpr float kAsin[] = {0.166666597f,  0.0750052184f, 0.0445137173f,
                                  0.0318258703f, 0.014412798f,  0.0374944434f};
// the same, shorter: 2^-27.6
inline constexpr float kAsinFast[] = {0.166667521f, 0.0749530643f, 0.0454697721f, 0.0241807736f,
                                      0.0421664119f};

// pi as a sum of floats.
inline constexpr float kPi[] = {3.14159274f, -8.74227766e-08f, -3.43024902e-15f};
// pi / 2 as a sum of floats.
inline constexpr float kHalfPi[] = {1.57079637f, -4.37113883e-08f, -1.71512451e-15f};
// pi / 4; j times the first part is exact for j <= 4 as a sum of floats.
inline constexpr float kQuarterPi[] = {0.785398006f, 1.56958237e-07f};
// ln 2 as a sum of floats.
inline constexpr float kLn2[] = {0.693147182f, -1.90465421e-09f};
// ln 2; e times the first part is exact for |e| < 256 as a sum of floats.
inline constexpr float kLn2Short[] = {0.693145752f, 1.42860677e-06f};
// 1 / ln 2 as a sum of floats.
inline constexpr float kLog2e[] = {1.44269502f, 1.92596303e-08f};
// 2 / ln 2 as a sum of floats.
inline constexpr float kTwoLog2e[] = {2.88539004f, 3.85192607e-08f};
// 2 / (3 ln 2) as a sum of floats.
inline constexpr float kTwoThirdsLog2e[] = {0.961796701f, -7.02846181e-09f};
// 2 / pi in base 2^14, first digit worth 2^-14.
inline constexpr int32_t kTwoOverPiDigits[] = {10430, 6198,  14649, 1045, 2687,  629,
                                               8007,  13620, 14192, 3510, 2646,  6460,
                                               4324,  1055,  14661, 9131, 14254, 15446};

}  // namespace kinora::jit::math
