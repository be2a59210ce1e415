// area and Du in a light
light light_derivatives() {
    illuminate(point "shader"(0, 0, 0)) {
        float fw = sqrt(area(Ps)) + length(Du(Ps)) * 0.1 + abs(Dv(xcomp(Ps)));
        Cl = 1 / (1 + fw);
    }
}
