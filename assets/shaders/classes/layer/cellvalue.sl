/* cellvalue.sl: a pattern for layers: value() is the distance to the nearest of scattered points, as
   crackle has it, from 0 at their borders to 1.
   Parameters: scale, sharp, __category (so that getshaders() finds patterns). */
class cellvalue(float scale = 2.4; float sharp = 0.8; string __category = "pattern";) {
    public float value(point Q) {
        point q = scale * Q, corner = point "current" (floor(q[0]), floor(q[1]), floor(q[2]));
        float first = 9, second = 9, i, j, k;
        for (i = -1; i <= 1; i += 1)
            for (j = -1; j <= 1; j += 1)
                for (k = -1; k <= 1; k += 1) {
                    point cell = corner + vector "current" (i + 0.5, j + 0.5, k + 0.5);
                    point middle = cell + 0.9 * (vector cellnoise(cell) - vector "current" (0.5, 0.5, 0.5));
                    float far = distance(q, middle);
                    if (far < first) {
                        second = first;
                        first = far;
                    } else if (far < second)
                        second = far;
                }
        return smoothstep(0, sharp, second - first);
    }
    public void surface(output color Ci, Oi) {
        Ci = Oi * value(2 * transform("object", P)) * (ambient() + diffuse(faceforward(normalize(N), I)));
    }
}
