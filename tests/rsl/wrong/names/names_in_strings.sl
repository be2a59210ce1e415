surface x() {
    Ci = color "hvs" (1, 1, 1) + ctransform("rbg", "hsv", Cs) * unknown;
    float a = spline("catmul-rom", s, 0, 0, 1, 1) + spline("solvelinaer", s, 0, 0, 1, 1);
    Oi = ctransform("HSV", Cs) + a + spline("solvecatmullrom", s, 0, 0, 1, 1);
}
//! 2:65 error RSL_UNKNOWN_VARIABLE unknown variable 'unknown'
//! 2:16 error RSL_COLOR_SPACE_UNKNOWN did you mean 'hsv'?
//! 2:45 error RSL_COLOR_SPACE_UNKNOWN did you mean 'rgb'?
//! 3:22 error RSL_SPLINE_BASIS did you mean 'catmull-rom'?
//! 3:60 error RSL_SPLINE_BASIS no spline basis is named 'solvelinaer'
