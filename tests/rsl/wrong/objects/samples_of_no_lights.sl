class x() {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, "all");
    }
}
//! 4:35 error RSL_2 directlighting() of lights other than getlights()'s belongs to the part of RSL 2.0 that is not supported yet
