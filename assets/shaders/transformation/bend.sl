/* bend.sl: bends what stands along z over towards x, as a reed in the wind.
   Parameters: curvature (degrees a unit), lowest: z where the bend begins. */
transformation bend(float curvature = 38; float lowest = -0.9;) {
    float k = radians(curvature);
    float z = zcomp(P) - lowest;
    if (z > 0 && abs(k) > 0.0001) {
        float angle = k * z;
        float radius = 1 / k - xcomp(P);
        P = point(1 / k - radius * cos(angle), ycomp(P), lowest + radius * sin(angle));
    }
}
