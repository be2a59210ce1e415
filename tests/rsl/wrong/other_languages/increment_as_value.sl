surface x() {
    float i = 0;
    float a = i++;
    Ci = a;
}
//! 3:16 error RSL_NOT_RSL write 'i += 1'
