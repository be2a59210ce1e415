// An array by itself is a statement without effect.
// world 5
surface fuzz(float f[2] = {1, 2}; string n[] = {"a","b"};) {
    float g[2];
    f; n; g; (f);
    Ci = f[1];
}
