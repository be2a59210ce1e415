class x() {
    public void lighting(output color Ci, Oi) {
        shader all[] = getlights();
        color c = 0;
        all[0]->shade(c);
        Ci = c;
    }
}
//! 5:9 warning RSL_LIGHT_METHOD a light has no method 'shade' of 1 arguments
