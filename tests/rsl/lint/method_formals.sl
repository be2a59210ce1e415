class x(float gain = 2; float idle = 3;) {
    public void evaluateSamples(string what; output __radiancesample r[]) {
        r[0]->setMaterialResponse(color gain, 1);
    }
    public void lighting(output color Ci, Oi) { Ci = directlighting(this, getlights()); }
}
//! 1:31 warning RSL_UNUSED_PARAMETER 'idle'
