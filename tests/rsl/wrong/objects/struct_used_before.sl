class x() {
    Layer dirt;
    public void surface(output color Ci, Oi) { Ci = 1; }
}
struct Layer { float amount = 0; }
//! 2:5 error RSL_STRUCT_LATER struct 'Layer' is not defined yet
