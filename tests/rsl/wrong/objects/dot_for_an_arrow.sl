struct Layer { float amount = 0; void init(float a) { amount = a; } }
class x() {
    Layer dirt;
    public void surface(output color Ci, Oi) {
        dirt.init(0.5);
        Ci = dirt.amount;
    }
}
//! 5:9 error RSL_STRUCT_AS_VALUE a whole struct cannot be used here
//! 6:14 error RSL_STRUCT_AS_VALUE a whole struct cannot be used here
