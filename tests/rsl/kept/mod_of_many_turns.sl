// Beyond 2^24 turns mod promises its range only.
// world 1687
surface fuzz( frame_0 = 1; vary_1 = 0.5; color vary_2 = 1; output float aov_3 = 0; ) {
 aov_3 = mod(vary_1, vary_2[0]) > - aov_3 ? vary_2[2] : v;
}
