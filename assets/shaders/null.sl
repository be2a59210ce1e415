/* null.sl: a surface that is there and shows nothing. */
surface null() {
    Oi = Os;
    Ci = 0;
}
