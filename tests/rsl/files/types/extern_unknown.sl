surface x(float Kd = 1;) {
    float f() {
        extern float Kd;
        extern float nothing;
        extern string Kd;
        return Kd;
    }
    Ci = f();
}
//! 4:22 error RSL_EXTERN_UNKNOWN extern 'nothing' names nothing outside the function
//! 5:23 error RSL_TYPE_MISMATCH extern 'Kd' needs float, this is string
