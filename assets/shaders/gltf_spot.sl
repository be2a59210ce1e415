/* gltf_spot.sl: KHR_lights_punctual: a point light in a cone around z, whole within inner_angle,
   nothing beyond outer_angle (both from the axis, radians). d in metres, each `unit` of the
   scene's. */
light gltf_spot(color lightcolor = 1; float intensity = 1; float range = 0; float inner_angle = 0;
                float outer_angle = 0.785398; float unit = 1;) {
    uniform vector axis = normalize(vector "shader" (0, 0, 1));
    illuminate(P, axis, outer_angle) {
        float d = length(L) / unit;
        float window = 1;
        if (range > 0)
            window = clamp(1 - pow(d / range, 4), 0, 1);
        float edge = cos(outer_angle);
        float cone = clamp(((L . axis) / length(L) - edge) / max(0.001, cos(inner_angle) - edge), 0, 1);
        Cl = lightcolor * intensity * window * cone * cone / (PI * d * d);
    }
}
