class x(string how = "veachpower2";) {
    public void evaluateSamples(string what; output __radiancesample s[]) { s[0]->valid = 0; }
    public void lighting(output color Ci, Oi) {
        Ci = directlighting(this, getlights(), "heuristic", how);
        Ci += directlighting(this, getlights(), "heuristic", "nonsense");
        Ci += directlighting(this, getlights(), "mis", 3);
        Ci += directlighting(this, getlights(), "integrationdomain", "ball");
    }
}
//! 5:62 error RSL_PAIR_VALUE optional parameter 'heuristic' of directlighting is nonsense, not veachpower2 or power or balance
//! 6:56 error RSL_PAIR_VALUE optional parameter 'mis' of directlighting is 3, not 0 (lights), 1 (both) or 2 (material)
//! 7:70 error RSL_PAIR_VALUE optional parameter 'integrationdomain' of directlighting is ball, not hemisphere or sphere
