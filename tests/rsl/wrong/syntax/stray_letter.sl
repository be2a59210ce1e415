surface x() {é Ci = 1;
    float ü = 2;
    Oi = ü ä;
}
//! 1:14 error RSL_BAD_CHARACTER unexpected 'é'
//! 3:13 error RSL_BAD_CHARACTER unexpected 'ä'
