// pnoise
surface noise_periodic() {
    Ci = pnoise(s * 4, 4) + float pnoise(s * 4, t * 4, 4, 2) * 0.5 + color pnoise(P, point(2, 2, 2)) * 0.5;
    Ci += float pnoise(P, 1, point(2, 2, 2), 3) * 0.1;
}
