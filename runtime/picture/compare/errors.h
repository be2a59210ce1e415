// runtime/picture/compare/errors.h: how far a picture is from another, in the numbers that people
// use.
#pragma once

#include "runtime/picture/compare/flip.h"
#include "runtime/picture/compare/picture.h"

namespace kinora {

// Pixels that are not finite count first; in the other numbers they are black.
struct PictureErrors {
    size_t non_finite = 0;     // pixels of the picture with a NaN or an infinity
    double mask_mismatch = 0;  // share of pixels covered (alpha >= 0.5) in one picture alone
    double rmse = 0;           // of linear colours: root of the mean over pixels and channels
    double relative_mse = 0;   // mean of d^2 / (r^2 + 0.01), r the reference
    double psnr = 0;           // dB, of sRGB-encoded colours in 0..1; infinite for equal pictures
    double ssim = 1;           // of encoded luma: 1 for equal pictures
    double flip = 0;           // mean of ldr_flip
    double flip_p99 = 0;       // 99 % of the pixels have less
    double hdr_flip = 0;       // mean of hdr_flip
    double max_error = 0;      // of linear colours
};

// Pictures of equal size. `map`, if given, gets ldr_flip's pixels.
PictureErrors picture_errors(const PictureView& picture, const PictureView& reference,
                             Plane* map = nullptr);

// A reference that many pictures are compared with: what their errors need of it is made once,
// but for HDR-FLIP of pictures so large that it would fill the memory.
class ReferencePicture {
  public:
    explicit ReferencePicture(const PictureView& reference);
    // As picture_errors says.
    PictureErrors errors_of(const PictureView& picture, Plane* map = nullptr) const;

  private:
    PictureView view() const { return {width_, height_, pixels_}; }

    int width_, height_;
    std::vector<vec4> pixels_;
    Plane luma_;
    FlipView flip_;
    HdrFlipViews hdr_;  // none: too large
};

// IEC 61966-2-1 of a linear value; limited to 0..1.
double encode_srgb(double linear);

// Rec. 709 luma of encoded colours, 0..1.
Plane encoded_luma(const PictureView& picture);

// Structural similarity, the mean over all pixels: Wang, Bovik, Sheikh, Simoncelli: "Image Quality
// Assessment: From Error Visibility to Structural Similarity", 2004, with its 11 x 11 Gaussian of
// sigma 1.5, K1 = 0.01, K2 = 0.03 and L = 1.
double ssim(const Plane& a, const Plane& b);

// The mean, and the value that `share` of them do not exceed. 0 of nothing.
double mean(const Plane& plane);
double percentile(std::vector<double> values, double share);

}  // namespace kinora
