surface x() {
    vec3 n = normalize(N);
    Ci = n;
}
//! 2:5 error RSL_UNKNOWN_TYPE write 'vector'
