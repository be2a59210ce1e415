// faceforward reflect refract fresnel normalize length distance ptlined rotate
surface geometry_builtins(float eta = 1.5) {
    normal Nf = faceforward(normalize(N), I);
    vector V = normalize(I), R = reflect(V, Nf), T = refract(V, Nf, 1 / eta), R2, T2;
    float kr, kt, kr2, kt2;
    fresnel(V, Nf, 1 / eta, kr, kt);
    fresnel(V, Nf, 1 / eta, kr2, kt2, R2, T2);
    point q = rotate(P, radians(30), point(0, 0, 0), point(0, 0, 1));
    Ci = color R * kr * 0.1 + color T * kt * 0.1 + color(R2 - T2) * 0.1 + kr2 * kt2;
    Ci += distance(P, q) * 0.1 + ptlined(point(0, 0, 0), point(1, 1, 1), P) * 0.1 + length(N) * 0.1;
    Ci += normalize(Cs) * 0.1 + color(faceforward(N, I, Ng)) * 0.01;
}
