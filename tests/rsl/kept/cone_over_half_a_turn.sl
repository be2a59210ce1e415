// world 49
// A cone whose angle, not known when compiled, is over half a turn lights everything.
light fuzz(float frame_22 = 0.4931;) {
    illuminate(P, vector 1, 3 + abs(frame_22)) {
        Cl = 1;
    }
    illuminate(P, vector 1, 0.5 + abs(frame_22)) {
        Cl = 0.5;
    }
}
