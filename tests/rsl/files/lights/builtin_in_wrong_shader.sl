light x() { solar() Cl = diffuse(N); }
imager y() { Ci = area(P); }
//! 1:26 error RSL_NOT_LEGAL_HERE 'diffuse' cannot be used in light shaders
//! 2:19 warning RSL_NO_DERIVATIVES 'area' finds no derivatives in imager shaders
