// Ns, the normal at the point being lit
light globals_ns(float Kf = 0.5) {
    illuminate(point "shader"(0, 0, 0)) { Cl = Kf * (normalize(Ns) . -normalize(L)); }
}
