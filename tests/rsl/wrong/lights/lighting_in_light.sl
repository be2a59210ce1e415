light x() { solar() { Cl = diffuse(Ns); } }
//! 1:28 error RSL_NOT_LEGAL_HERE 'diffuse' cannot be used in light shaders
