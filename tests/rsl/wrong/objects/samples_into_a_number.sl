class x() {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, getlights(), "diffuseresult", 1);
    }
}
//! 4:65 error RSL_OUTPUT_ARGUMENT argument "diffuseresult" of 'directlighting' is written to and must be a variable
