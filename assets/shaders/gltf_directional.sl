/* gltf_directional.sl: KHR_lights_punctual: `intensity` lux along z. Cl is irradiance over PI. */
light gltf_directional(color lightcolor = 1; float intensity = 1;) {
    solar(vector "shader" (0, 0, 1), 0) {
        Cl = lightcolor * intensity / PI;
    }
}
