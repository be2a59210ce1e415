// displacement of P along N in shader space
displacement displacement_true(float Km = 0.2, freq = 4; string space = "shader") {
    normal n = normalize(N);
    point PP = transform(space, P);
    float mag = 0, i;
    for (i = 0; i < 3; i += 1) mag += (noise(PP * freq * pow(2, i)) - 0.5) / pow(2, i);
    P += n * (mag * Km) / length(vtransform("shader", n));
    N = normalize(calculatenormal(P));
}
