// depth() is along the camera's z, in displacements too, whose current is the object's space
// world 3933
displacement fuzz(varying color vary_7 = 1; ) {
 float r8[1] = {1};
 r8[u] -= depth(point rotate(point N, r8[t], 1, E));
 P += r8[3];
}
surface shown() { Oi = Ci = 1; }
