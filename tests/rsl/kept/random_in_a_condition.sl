// A loop's first condition stands outside of its turns.
// world 1085
surface fuzz( frame_7 = 1.424;  frame_8 = -1.285;  own_9 = 1; vary_10 = 1.498; ) {
 debug(0.5);
 clamp(1, 1, 1) <= vary_10;
 matrix x17 = rotate(1, 1, 1);
 float i18 = 0;
 while (dv <= random() && i18 < 4) {
  Ci = Oi;
 }
}
