/* default_fill.sl: the fill light of scenes that bring no light: as soft as the half of the sky around
   `from`, so that it reaches all that the camera sees. It makes no highlights.
   Parameters: lightcolor, from (where its middle is; the camera carries it). */
light default_fill(color lightcolor = 1;
                   vector from = vector "camera" (0.51, -0.26, -0.82);
                   output float __nonspecular = 1;) {
    uniform vector f = normalize(from);
    vector n = normalize(vector Ns);
    /* The part of a bright half of the sky around f that a plane with the normal n sees shines as one
       light from f + n, worth (1 + f . n) / 2: Lambert's formula for the light of polygons. */
    solar(-(f + n), 0) {
        Cl = 0.5 * length(f + n) * lightcolor;
    }
    /* The same for the plane's other side, which surfaces show that turn N to the eye. */
    solar(n - f, 0) {
        Cl = 0.5 * length(f - n) * lightcolor;
    }
}
