class x(float scale = 2; float other = 3; shader below = null;) {
    public float value(float a; float b) {
        float turned = a * 2;
        float lost = 1;
        return below->value(turned * scale, b);
    }
}
//! 4:15 warning RSL_UNUSED_VARIABLE 'lost'
