struct A { float k[3]; float middle() { return k[1]; } }
float first(A a) { return a->k[0]; }
class x() {
    A a[2];
    public void surface(output color Ci, Oi) {
        Ci = a[1]->middle() + first(a[0]);
        float list[3] = a[0]->k;
    }
}
//! 6:14 error RSL_STRUCT_ELEMENT struct 'A' stands in an array of structs that hold arrays
//! 6:37 error RSL_STRUCT_ELEMENT struct 'A' stands in an array of structs that hold arrays
//! 7:25 error RSL_STRUCT_ELEMENT 'a->k' stands in an array of structs that hold arrays
