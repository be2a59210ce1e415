struct Layer { float amount = 0; void init() { amount = 1; } }
class x() {
    Layer dirt;
    public void surface(output color Ci, Oi) {
        dirt->init;
        Ci = dirt->amount;
    }
}
//! 5:9 error RSL_NO_MEMBER struct 'Layer' has no member 'init'
