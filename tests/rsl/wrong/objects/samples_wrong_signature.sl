class x() {
    public void evaluateSamples(output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, getlights());
    }
}
//! 4:14 error RSL_NO_SAMPLE_METHOD directlighting() needs a method that class 'x' does not have: evaluateSamples(string what; output __radiancesample samples[])
