/* tintedinterior.sl: the inside of coloured glass or a jar of syrup: each colour is swallowed at its
   own rate along the way through the body (Beer's law). An interior volume.
   Parameters: distance (the way after which `tint` is left), tint, murk (a milky share). */
volume tintedinterior(float distance = 1; color tint = color(0.75, 0.25, 0.08); float murk = 0.04;
                      color murkcolor = color(0.9, 0.6, 0.3);) {
    float way = length(I) / distance;
    color through = color(pow(tint[0], way), pow(tint[1], way), pow(tint[2], way));
    float milk = 1 - exp(-murk * way);
    Ci = mix(Ci * through, murkcolor * tint, milk);
    Oi = 1 - (1 - Oi) * through * (1 - milk);
}
