/* twistedrope.sl: three strands laid around each other, each of many yarns; along s of a ring, or
   around a ball.
   Parameters: turns (along s), strands, depth, yarns (on a strand), yarndepth. */
displacement twistedrope(float turns = 22; float strands = 3; float depth = 0.09; float yarns = 9;
                         float yarndepth = 0.16;) {
    float a = turns * s + strands * t;
    float strand = abs(sin(PI * a));
    float phase = a - floor(a);
    float yarn = abs(sin(PI * (yarns * phase - 3 * turns * s)));
    float height = sqrt(strand) + yarndepth * sqrt(yarn + 0.01) * strand;
    P += depth * (height - 0.6) * normalize(N);
    N = calculatenormal(P);
}
