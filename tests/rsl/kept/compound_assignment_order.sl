// a += b reads a before b is computed.
// world 3050
point f0(float a1; color a2; ) {
 P = 1;
}
displacement fuzz( own_7 = 3; ) {
 color x10 = 1;
 P += f0(du, x10);
}
