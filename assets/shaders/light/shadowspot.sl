/* shadowspot.sl: a spotlight that asks for its shadow itself: from the map `shadowname`, or with
   "raytrace" from rays, blurred and coloured as wanted.
   Parameters: as spotlight, angles in degrees; shadowname, blur, samples, bias, shadowcolor. */
light shadowspot(float intensity = 22; color lightcolor = color(1, 0.95, 0.88);
                 color shadowcolor = color(0.08, 0.05, 0.22); string shadowname = "raytrace";
                 float blur = 0.03; float samples = 8; float bias = 0.01;
                 float coneangle = 25; float conedeltaangle = 7; float beamdistribution = 2;
                 output float shaded = 0;) {
    uniform vector axis = normalize(vector "shader" (0, 0, 1));
    uniform float outer = cos(radians(coneangle));
    uniform float inner = cos(radians(coneangle - conedeltaangle));
    illuminate(point "shader" (0, 0, 0), axis, radians(coneangle)) {
        float cosangle = (L . axis) / length(L);
        float atten = pow(cosangle, beamdistribution) * smoothstep(outer, inner, cosangle) / (L . L);
        shaded = 0;
        if (shadowname != "")
            shaded = float shadow(shadowname, Ps, "blur", blur, "samples", samples, "bias", bias);
        Cl = atten * intensity * mix(lightcolor, shadowcolor, shaded);
    }
}
