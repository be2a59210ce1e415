/* emission.sl: the light of surfaces that emit (--gi): the renderer samples their triangles, and in
   the place of Cl puts what each surface shows without other light
   (runtime/picture/shading/lighting/emission.cpp). It is a part of indirect light, and counts where
   that does. */
light emission(output float __nonspecular = 1; output string __category = "indirect";) {
    illuminate(P)
        Cl = 1;
}
