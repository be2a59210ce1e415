// world 3527
surface fuzz( frame_0 = -1.677;  frame_1 = 0.25;  own_2 = -0.9177; vary_3 = 1; vary_4 = -0.776; aov_5 = 0.5; ) {
 float x7 = 1;
 color x13 = 1;
 x7 -= 1;
 Cs = pow(Oi, specular(normal - Ps, E, x7));
 x13 = Cs;
 Ci += 0.125 * x13;
}
