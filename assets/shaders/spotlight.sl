/* spotlight.sl: a cone of light with a soft edge; angles in radians. */
light spotlight(float intensity = 1; color lightcolor = 1;
                point from = point "shader" (0, 0, 0); point to = point "shader" (0, 0, 1);
                float coneangle = radians(30); float conedeltaangle = radians(5);
                float beamdistribution = 2;) {
    uniform vector axis = normalize(to - from);
    illuminate(from, axis, coneangle) {
        float cosangle = (L . axis) / length(L);
        float attenuation = pow(cosangle, beamdistribution) / (L . L);
        attenuation *= smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), cosangle);
        Cl = attenuation * intensity * lightcolor;
    }
}
