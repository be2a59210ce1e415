// ambient diffuse specular specularbrdf phong
surface lighting_builtins() {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    Ci = Cs * (ambient() + diffuse(Nf)) + specular(Nf, V, 0.1) + phong(Nf, V, 10);
    illuminance(P, Nf, PI / 2) Ci += Cl * specularbrdf(normalize(L), Nf, V, 0.2);
}
