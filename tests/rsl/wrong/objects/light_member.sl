class x() {
    public void lighting(output color Ci, Oi) {
        shader all[] = getlights("category", "key");
        Ci = all[0]->intensity;
    }
}
//! 4:14 error RSL_LIGHT_MEMBER 'intensity' of a light is not read in this way
