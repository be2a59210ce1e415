class x() {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        float d = 0;
        directlighting(this, getlights(), "diffuseresult", d);
        Ci = d;
    }
}
//! 5:60 error RSL_OUTPUT_TYPE argument 5 of 'directlighting' must be a variable of type color, this is float
