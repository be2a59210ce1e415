// runtime/picture/compare/flip.h: FLIP, the difference that a viewer sees who alternates two
// pictures. LDR: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild: "FLIP: A
// Difference Evaluator for Alternating Images", HPG 2020. HDR: Andersson, Nilsson, Shirley,
// Akenine-Moller: "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics Short
// Papers 2021.
#pragma once

#include "runtime/picture/compare/picture.h"

namespace kinora {

// Pixels per degree of a viewer 0.7 m from a screen of 3840 pixels and 0.7 m: the papers' 67.
double flip_pixels_per_degree(double distance_m = 0.7, double screen_m = 0.7,
                              double screen_pixels = 3840);

// L* a* b* (D65) of linear RGB, a and b after the Hunt effect: times 0.01 L.
dvec3 hunt_lab(const dvec3& linear_rgb);
// |dL| + the length of (da, db).
double hyab(const dvec3& lab_a, const dvec3& lab_b);
// The largest colour error, between green and blue, to the power 0.7.
double flip_largest_color_error();

// 0 (equal) to 1, one number a pixel, symmetric in its pictures. Colours are clamped to 0..1 and
// stand on black; the pictures have equal sizes.
Plane ldr_flip(const PictureView& a, const PictureView& b,
               double pixels_per_degree = flip_pixels_per_degree());

// What a viewer sees of one picture. Of a picture that many are compared with, it is made once.
struct FlipView {
    std::vector<dvec3> colors;  // as hunt_lab has them, blurred by the eye
    Plane edges, points;        // how strong they are
};
FlipView flip_view(const PictureView& picture, double pixels_per_degree = flip_pixels_per_degree());
Plane ldr_flip(const FlipView& a, const FlipView& b);

// The exposures, in stops, at which hdr_flip looks at pictures of that reference.
struct FlipExposures {
    double first = 0, last = 0;
    int count = 2;
    double at(int i) const { return first + (last - first) * i / (count - 1); }
};
FlipExposures flip_exposures(const PictureView& reference);

// The largest ldr_flip over the exposures of the reference, tone mapped by ACES.
Plane hdr_flip(const PictureView& picture, const PictureView& reference,
               double pixels_per_degree = flip_pixels_per_degree());

// A reference as hdr_flip sees it: a view an exposure.
struct HdrFlipViews {
    FlipExposures exposures;
    std::vector<FlipView> views;
};
HdrFlipViews hdr_flip_views(const PictureView& reference,
                            double pixels_per_degree = flip_pixels_per_degree());
Plane hdr_flip(const PictureView& picture, const HdrFlipViews& reference,
               double pixels_per_degree = flip_pixels_per_degree());

}  // namespace kinora
