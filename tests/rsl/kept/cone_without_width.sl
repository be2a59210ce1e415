// Whether a point on the axis of a cone without width is lit is decided by rounding.
// world 880002516
light fuzz() {
    illuminate(point P, I, ycomp(P)) {
        Cl = 1;
    }
}
