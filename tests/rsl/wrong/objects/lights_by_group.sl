class x() {
    public void lighting(output color Ci, Oi) {
        shader all[] = getlights("group", "key");
        Ci = arraylength(all);
    }
}
//! 3:24 error RSL_LIGHT_QUERY getlights() cannot stand here, or not with these arguments
