class x() {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, getlights(), "mis", "on");
    }
}
//! 4:55 warning RSL_PAIR_TYPE optional parameter 'mis' of directlighting is a float, not a string, and is left out
