surface x() {
    Ci = 1;
    return;
}
//! 3:5 warning RSL_SHADER_RETURN return outside a function
