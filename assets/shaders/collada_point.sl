/* collada_point.sl: COLLADA 1.4.1 <point>: A = constant + linear * d + quadratic * d^2, Cl / A, d in
   units of the file that has the light, each `unit` of the scene's. */
light collada_point(color lightcolor = 1; float intensity = 1; float constant_attenuation = 1;
                    float linear_attenuation = 0; float quadratic_attenuation = 0; float unit = 1;) {
    illuminate(P) {
        float d = length(L) / unit;
        Cl = intensity * lightcolor /
             (constant_attenuation + d * (linear_attenuation + d * quadratic_attenuation));
    }
}
