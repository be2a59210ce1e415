surface x() {
    float i = 0;
    do { i += 1; } while (i < 3);
    Ci = i;
}
//! 3:5 error RSL_NOT_RSL write 'while (...) { ... }'
