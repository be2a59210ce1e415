#define SIZE 4;
surface x() {
    float a = SIZE * 2;
    Ci = a;
}
//! 3:20 error RSL_SYNTAX before '*'
