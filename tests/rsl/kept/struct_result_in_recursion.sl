// world 3513
struct Inner { float w = 0.5; color c = 1; }
struct Both { vector v = 1; Inner inner; Inner other;
 swap() { Inner = inner; inner = other; other->w += kept->w; } }
Inner mixed(Inner a; float by) { Inner r = a; r->w *= by; r->c += by; return r; }
float f0(float a1; a2;) {
 f0(float 1, 1);
 Both o7;
 o7->other = mixed(o7->inner, 1);
}
light fuzz( frame_14 = -0.3026;  frame_15 = 1;  own_16 = -1.19; ) {
  float i51 = 0;
  while (0.5) {
 float x57 = i51 <= f0(1, 1) ? 1 : 1;
  }
   float x79 = f0(1, 1);
}
