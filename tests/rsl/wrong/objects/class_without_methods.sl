class co(float a = 1;) {
    public color tint(point p) { return a * color p; }
}
//! 1:1 error RSL_CLASS_WITHOUT_METHODS class 'co' has no method that the renderer calls
