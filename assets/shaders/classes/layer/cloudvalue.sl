/* cloudvalue.sl: a pattern for layers: value() is noise of several octaves, from 0 to 1.
   Parameters: scale, octaves, contrast, __category (so that getshaders() finds patterns). */
class cloudvalue(float scale = 1.3; float octaves = 5; float contrast = 1.6;
                 string __category = "pattern";) {
    public float value(point Q) {
        float sum = 0, weight = 0.5, k;
        point q = scale * Q;
        for (k = 0; k < octaves; k += 1) {
            sum += weight * float noise(q);
            q = 2.03 * q + vector(3.7, 1.3, 5.1);
            weight *= 0.5;
        }
        return clamp(0.5 + contrast * (sum - 0.5), 0, 1);
    }
    public void surface(output color Ci, Oi) {
        Ci = Oi * value(3 * transform("object", P)) * (ambient() + diffuse(faceforward(normalize(N), I)));
    }
}
