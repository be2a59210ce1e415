/* collada_spot.sl: COLLADA 1.4.1 <spot>: a point light in a cone around z. falloff_angle is that
   of the whole cone in degrees; falloff_exponent as GL_SPOT_EXPONENT;
   d in units of the file that has the light, each `unit` of the scene's. */
light collada_spot(color lightcolor = 1; float constant_attenuation = 1;
                   float linear_attenuation = 0; float quadratic_attenuation = 0;
                   float falloff_angle = 180; float falloff_exponent = 0;
                   float unit = 1;) {
    uniform vector axis = normalize(vector "shader" (0, 0, 1));
    uniform float half_angle = radians(0.5 * falloff_angle);
    illuminate(P, axis, half_angle) {
        float d = length(L) / unit;
        float cosangle = max((L . axis) / length(L), 0);
        Cl = lightcolor * pow(cosangle, falloff_exponent) /
             (constant_attenuation + d * (linear_attenuation + d * quadratic_attenuation));
    }
}
