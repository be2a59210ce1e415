class x() {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, "all");
    }
}
//! 4:35 error RSL_HANDLE_WANTED this is no shader
