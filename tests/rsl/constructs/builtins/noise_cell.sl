// cellnoise of every form
surface noise_cell() {
    float a = cellnoise(s * 8), b = float cellnoise(s * 8, t * 8);
    color c = cellnoise(P * 4);
    point p = cellnoise(P * 4, 2);
    Ci = c * a + color p * b + vector cellnoise(s * 3) * 0.1;
}
