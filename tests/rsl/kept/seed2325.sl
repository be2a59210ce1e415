// world 2325
float f0(float a1; a2;) {
  P = pow(P, rotate(point 1, 1, E, (0.25, 0.25, -1.87)));
}
displacement fuzz( frame_6 = 1; ) {
  color r19[4] = {1, 1};
  r19[f0(ncomps, du)] -= r19[-2];
}
