class x() {
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, getlights());
    }
}
//! 3:14 error RSL_NO_SAMPLE_METHOD directlighting() needs a method that class 'x' does not have: evaluateSamples(string what; output __radiancesample samples[])
