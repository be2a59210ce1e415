// mix(a, b, 1) is b, however large a is.
// world 549
surface fuzz( frame_20 = 1;  frame_21 = 0.5; vary_22 = 1.562; color vary_23 = 1; aov_24 = -1.38; ) {
 color x29 = mix(vary_23, 1, 1);
 Ci = x29;
}
