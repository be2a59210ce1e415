/* rayprobe.sl: shows how a point is seen: red by the rays before this one, green by how far the ray
   went, blue by how it points up; striped where a ray with the label `marked` sees it.
   Parameters: reach (of the green), marked. */
surface rayprobe(float reach = 10; string marked = "gloss";) {
    vector way = vtransform("world", raydirection());
    float far = distance(rayorigin(), P);
    float agree = abs(far - raylength()) < 1e-3 * far ? 1 : 0;
    Oi = Os;
    Ci = color(min(1, raydepth() / 4), agree * min(1, far / reach), 0.5 + 0.5 * ycomp(way));
    if (raylabel() == marked)
        Ci *= 0.5 + 0.5 * step(0.5, mod(s * 16, 1));
}
