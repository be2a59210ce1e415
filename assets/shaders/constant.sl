/* constant.sl: the surface's own color, without light. */
surface constant() {
    Oi = Os;
    Ci = Os * Cs;
}
