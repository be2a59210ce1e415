// trailing separators; empty parameter lists; ';' behind a definition
float nothing() { return 0.5; };
surface parameters_trailing(float a = 1,; color c = 0.5;;) {
    Ci = c * a + nothing();;
    Oi = 1;
};
