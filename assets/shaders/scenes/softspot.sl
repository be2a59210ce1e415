/* softspot.sl: a lamp with a round opening: a cone with a soft edge, and shadows that soften with
   distance, because each sample of a pixel sees it from another point of the opening. */
light softspot(float intensity = 30; color lightcolor = color(1, 0.86, 0.68);
               float radius = 0.12; float coneangle = 0.5; float conedeltaangle = 0.2;) {
    uniform point centre = point "shader" (0, 0, 0);
    uniform vector axis = normalize(vector "shader" (0, 0, 1));
    uniform vector across = normalize(vector "shader" (1, 0, 0));
    uniform vector down = normalize(vector "shader" (0, 1, 0));
    float r = radius * sqrt(float random());
    float a = 2 * PI * float random();
    illuminate(centre + r * (cos(a) * across + sin(a) * down), axis, coneangle) {
        float cosangle = (L . axis) / length(L);
        float edge = smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), cosangle);
        Cl = intensity * edge / (L . L) * lightcolor;
    }
}
