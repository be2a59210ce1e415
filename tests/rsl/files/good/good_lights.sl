light ambientlight(float intensity = 1; color lightcolor = 1) { Cl = intensity * lightcolor; }
light distantlight(float intensity = 1; color lightcolor = 1;
                   point from = point "shader" (0, 0, 0), to = point "shader" (0, 0, 1);) {
    solar(to - from, 0.0) Cl = intensity * lightcolor;
}
light pointlight(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0)) {
    illuminate(from) Cl = intensity * lightcolor / (L . L);
}
light spotlight(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0),
                to = point "shader" (0, 0, 1); float coneangle = radians(30),
                conedeltaangle = radians(5), beamdistribution = 2;) {
    uniform vector A = (to - from) / length(to - from);
    uniform float outer = cos(coneangle), inner = cos(coneangle - conedeltaangle);
    illuminate(from, A, coneangle) {
        float cosangle = L . A / length(L);
        float atten = pow(cosangle, beamdistribution) / (L . L);
        atten *= smoothstep(outer, inner, cosangle);
        Cl = atten * intensity * lightcolor;
    }
}
