/* default_rim.sl: the rim light of scenes that bring no light: from behind, so that upper edges stand
   out. It makes no highlights.
   Parameters: lightcolor, from (where it is; the camera carries it). */
light default_rim(color lightcolor = 1;
                  vector from = vector "camera" (0.37, 0.67, 0.64);
                  output float __nonspecular = 1;) {
    solar(-from, 0) {
        Cl = lightcolor;
    }
}
