// ptlined of an end point is 0.
// world 4793
surface fuzz( frame_12 = 1;  frame_13 = -0.2469;  own_14 = 1e-3; vary_15 = 1.676; ) {
 point x22 = P;
 float i23 = 0;
 while (1 && i23 < 4) {
  i23 += 1;
  x22 *= x22;
 }
 float i24 = 0;
 while (float i24 != ptlined(1, x22, x22) && i24 < 4) {
  i24 += 1;
 }
 float i38 = 0;
 float i42 = 0;
 while (i24 <= i38 && i42 < 4) {
  i42 += 1;
 }
 Ci = (float 1, vary_15, frame_13 / + i42);
}
