surface x(float knots[] = {1, 2, 3};) {
    float a[2] = {1, 2, 3};
    float b[3];
    float c[] = 2;
    color d[0];
    b = a;
    b = knots;
    Ci = b;
    Ci = s[1];
    Ci = b[2] + knots[0];
}
//! 5:13 error RSL_BAD_ARRAY_LENGTH array length must be a whole number of 1 or more
//! 2:18 error RSL_ARRAY_LENGTH 3 values for an array of 2
//! 4:17 error RSL_TYPE_MISMATCH 'c' needs float[], this is float
//! 6:9 error RSL_TYPE_MISMATCH 'b' needs float[3], this is float[2]
//! 8:10 error RSL_ARRAY_AS_VALUE a whole array cannot be used here
//! 9:10 error RSL_NOT_ARRAY only arrays and triples can be indexed, this is float
