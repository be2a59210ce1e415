class x(color other = 1; shader lamp = null;) {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(other, getlights());
        Ci += directlighting(this, lamp);
        Ci += directlighting(lamp);
    }
}
//! 4:29 error RSL_HANDLE_WANTED this is no shader
//! 5:36 error RSL_HANDLE_WANTED this is no shader
//! 6:15 error RSL_ARGUMENT_COUNT 'directlighting' takes 2 argument(s), 1 given
