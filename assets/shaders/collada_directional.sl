/* collada_directional.sl: COLLADA 1.4.1 <directional>: along -z of the light's node, where
   its space has z. */
light collada_directional(color lightcolor = 1;) {
    solar(vector "shader" (0, 0, 1), 0) {
        Cl = lightcolor;
    }
}
