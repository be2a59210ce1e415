surface x() {
    float a = 1
    float b = 2;
    Ci = a * b
}
//! 2:16 error RSL_SYNTAX expected ';' before 'float'
//! 4:15 error RSL_SYNTAX expected ';' before '}'
