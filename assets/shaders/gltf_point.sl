/* gltf_point.sl: KHR_lights_punctual: `intensity` candela, 1 / d^2, smoothly 0 at `range` where that
   is not 0 (the extension's recommended window). d in metres, each `unit` of the scene's. */
light gltf_point(color lightcolor = 1; float intensity = 1; float range = 0; float unit = 1;) {
    illuminate(P) {
        float d = length(L) / unit;
        float window = 1;
        if (range > 0)
            window = clamp(1 - pow(d / range, 4), 0, 1);
        Cl = lightcolor * intensity * window / (PI * d * d);
    }
}
