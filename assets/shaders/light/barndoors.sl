/* barndoors.sl: a theatre spotlight with four flaps that cut the round cone to a window shape.
   Parameters: intensity, coneangle and penumbra in degrees; left, right, top, bottom: how far each
   flap is open (0 shut .. 1 out of the beam); edge (their softness), lightcolor. */
light barndoors(float intensity = 24; color lightcolor = color(1, 0.86, 0.62);
                float coneangle = 24; float penumbra = 6; float left = 0.55; float right = 0.75;
                float top = 0.8; float bottom = 0.45; float edge = 0.04;) {
    point from = point "shader" (0, 0, 0);
    uniform vector axis = normalize(vector "shader" (0, 0, 1));
    uniform float outer = radians(coneangle);
    uniform float inner = radians(coneangle - penumbra);
    illuminate(from, axis, outer) {
        vector beam = vtransform("shader", L);
        float away = max(zcomp(beam), 0.0001);
        float x = xcomp(beam) / away / tan(outer);
        float y = ycomp(beam) / away / tan(outer);
        float open = smoothstep(-left - edge, -left + edge, x) *
                     (1 - smoothstep(right - edge, right + edge, x)) *
                     smoothstep(-bottom - edge, -bottom + edge, y) *
                     (1 - smoothstep(top - edge, top + edge, y));
        float angle = acos(clamp((L . axis) / length(L), -1, 1));
        open *= 1 - smoothstep(inner, outer, angle);
        Cl = intensity * open * lightcolor / (L . L);
    }
}
