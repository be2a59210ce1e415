surface x() {
    printf("one
            two\n");
    Ci = nowhere;
}
//! 2:12 error RSL_UNTERMINATED_STRING closing quote
//! 4:10 error RSL_UNKNOWN_VARIABLE 'nowhere'
