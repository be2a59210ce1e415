/* show_st.sl: texture coordinates as red and green. */
surface show_st() {
    Oi = Os;
    Ci = Os * color(s, t, 0);
}
