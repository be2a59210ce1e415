// fresnel() promises nothing for vectors that are not of length 1.
// world 10042
surface fuzz( frame_0 = 3;  frame_1 = 1e-3;  own_2 = 1.046; vary_3 = 1; vary_4 = 1.989; output float aov_5 = -0.75; ) {
 float x6 = 1;
 fresnel(vector 1, 1, 1, aov_5, x6);
}
