/* clamptoalpha.sl: no component above the pixel's coverage, as displays of eight bits want it. */
imager clamptoalpha() {
    Ci = min(Ci, color(alpha));
}
