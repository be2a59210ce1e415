class co(float a = 1;) {
    public color tint = 1;
}
//! 1:1 error RSL_CLASS_WITHOUT_METHODS class 'co' has no methods
