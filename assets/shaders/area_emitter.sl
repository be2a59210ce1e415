/* area_emitter.sl: what a light on geometry looks like when its material has no surface. */
surface area_emitter(color lightcolor = 1) {
    Oi = 1;
    Ci = lightcolor;
}
