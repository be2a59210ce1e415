/* knurl.sl: the grip of a tool: two crossed sets of grooves that leave little pyramids.
   Parameters: freq (grooves around s), pitch (along t), depth, start and stop of the band in t. */
#define TRIANGLE(x) (1 - 2 * abs(mod((x), 1) - 0.5))

displacement knurl(float freq = 36; float pitch = 18; float depth = 0.055; float start = 0.30;
                   float stop = 0.70;) {
    float a = TRIANGLE(freq * s + pitch * t);
    float b = TRIANGLE(freq * s - pitch * t);
    float edge = 0.012;
    float band = smoothstep(start - edge, start, t) * (1 - smoothstep(stop, stop + edge, t));
    float cut = min(1, 1.5 * min(a, b)) - 1;
    P += depth * band * (0.55 + cut) * normalize(N);
    N = calculatenormal(P);
}
