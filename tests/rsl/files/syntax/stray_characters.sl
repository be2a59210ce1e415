surface x() {
    Ci = 1 @ 2;
    float a = 1e99;
    float b[-1];
    Ci = 'c';
}
//! 2:12 error RSL_BAD_CHARACTER unexpected '@'
//! 3:15 warning RSL_BAD_NUMBER number '1e99' is out of range
//! 4:13 error RSL_BAD_ARRAY_LENGTH array length must be a whole number of 1 or more
//! 5:10 error RSL_BAD_CHARACTER unexpected ''c''
