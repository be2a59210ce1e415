surface x(string map = "given.tex";) {
    color c = texture("names.sl") + texture("nosuch.tex", s, t);
    Ci = c * float environment("raytrace", N) * float texture(map) + color texture("", s, t);
    Ci += float shadow("none.shd", P);
}
//! 2:45 warning RSL_TEXTURE_MISSING 'nosuch.tex'
//! 4:24 warning RSL_TEXTURE_MISSING 'none.shd'
