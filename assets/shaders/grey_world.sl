/* grey_world.sl: the same light from all sides, without highlights: Blender's world, which its exporters
   leave out.
   Parameters: lightcolor. */
light grey_world(color lightcolor = 0.05; output float __nonspecular = 1;) {
    vector n = normalize(vector Ns);
    /* A diffuse surface in a sphere of one brightness is as bright as under that brightness from along
       its normal; once for each side, as surfaces turn N to the eye. */
    solar(-n, 0) {
        Cl = lightcolor;
    }
    solar(n, 0) {
        Cl = lightcolor;
    }
}
