// lightsource() fills arrays; built-ins write them back.
// world 20872
surface fuzz( frame_0 = 0.5;  own_1 = 0.8521; vary_2 = 2; vary_3 = 1; ) {
 float x4 = own_1;
 color r5[4] = {color Cs, 1};
 illuminance(0.5) {
  x4 -= lightsource("world", r5);
 }
 float x15 = 1;
 Ci = r5[x15];
}
