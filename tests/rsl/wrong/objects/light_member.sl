class x() {
    public void lighting(output color Ci, Oi) {
        shader all[] = getlights("category", "key");
        if (s > 0) all[0] = getshader("base");
        Ci = all[0]->intensity;
        all[0]->intensity = 2;
    }
}
//! 6:9 error RSL_CO_SHADER_WRITE members of another shader can be read only
