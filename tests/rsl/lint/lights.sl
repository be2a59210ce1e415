light dark(float intensity = 1;) {
    float power = intensity;
    illuminate(P) { power *= 2; Ol = power; }
}
void lit(float amount) { Cl = amount; }
light bright() { illuminate(P) lit(1); }
light flat(color c = 1;) { Cl = c; }
//! 1:7 warning RSL_DARK_LIGHT 'dark' lights nothing
