/* ri_shadowspot.sl: "shadowspot" as RenderMan's books have it: a spotlight that looks its shadow up.
   Angles in radians. */
light ri_shadowspot(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0);
                    point to = point "shader" (0, 0, 1); float coneangle = radians(30);
                    float conedeltaangle = radians(5); float beamdistribution = 2;
                    string shadowname = ""; float samples = 16; float width = 1; float blur = 0.01;
                    float bias = 0.01;) {
    uniform vector axis = normalize(to - from);
    uniform float outer = cos(coneangle);
    uniform float inner = cos(coneangle - conedeltaangle);
    illuminate(from, axis, coneangle) {
        float cosangle = (L . axis) / length(L);
        float atten = pow(cosangle, beamdistribution) / (L . L) * smoothstep(outer, inner, cosangle);
        if (shadowname != "")
            atten *= 1 - float shadow(shadowname, Ps, "samples", samples, "swidth", width, "twidth",
                                      width, "blur", blur, "bias", bias);
        Cl = atten * intensity * lightcolor;
    }
}
