// world 382
// The ramp of filterstep has a slope.
displacement fuzz(float frame_0 = 1; varying float vary_2 = -1;) {
    P += vector (filterstep(vary_2, -2, 3), filterstep(vary_2, frame_0), 1);
    N = calculatenormal(P);
}
