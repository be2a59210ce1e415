class x() {
    public void lighting(output color Ci, Oi) {
        shader all[] = getlights();
        color c = 0;
        all[0]->shade(c);
        Ci = c;
    }
}
//! 5:9 error RSL_LIGHT_METHOD 'shade' of a light cannot be called
