class x(color other = 1;) {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(other, getlights());
    }
}
//! 4:14 error RSL_2 'directlighting()' of another shader than 'this' belongs to the part of RSL 2.0 that is not supported yet
