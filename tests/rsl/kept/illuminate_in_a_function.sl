void lit(float a) { illuminate(P) Cl=a; }
light l1(){ lit(2); }
