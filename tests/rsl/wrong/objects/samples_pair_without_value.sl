class x() {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, getlights(), "mis");
    }
}
//! 4:48 error RSL_PAIR_NAME optional arguments of 'directlighting' come as "name", value
