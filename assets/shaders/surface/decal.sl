/* decal.sl: lacquer with an emblem laid on by a projection of its own: a matrix moves object space to
   the emblem's space, whatever s and t are.
   Parameters: where, size, turn (degrees) of the emblem; image, or "" for a painted roundel; body and
   emblem colours, Ka Kd Ks roughness. */
surface decal(float Ka = 1; float Kd = 0.75; float Ks = 0.6; float roughness = 0.05;
              float size = 0.62; float turn = 20; string image = ""; float reportonce = 0;
              point where = point "object" (0, 0, 0);
              color bodycolor = color(0.06, 0.20, 0.14); color ringcolor = color(0.75, 0.10, 0.06);
              color fieldcolor = color(0.85, 0.82, 0.72);) {
    /* World or object to emblem: move, turn, shrink. Rows are vectors, so the first comes first. */
    uniform float k = 1 / size;
    matrix emblem = mtransform("object", matrix "object" 1);
    emblem = scale(matrix 1, point(k, k, k));
    emblem = rotate(emblem, radians(turn), vector(0, 1, 0));
    emblem = translate(emblem, point(0, 0, 0) - transform("object", where));
    if (determinant(emblem) == 0)
        emblem = matrix 1;
    point Q = transform(emblem, transform("object", P));

    float x = xcomp(Q);
    float y = zcomp(Q);
    float front = step(0, -ycomp(Q));
    float r = sqrt(x * x + y * y);
    float w = max(length(vector(Du(x), Du(y), 0)) * du + length(vector(Dv(x), Dv(y), 0)) * dv, 0.001);
    color Ct = bodycolor;
    float inside = front * (1 - smoothstep(1 - w, 1 + w, r));
    color mark;
    if (image != "") {
        mark = color texture(image, 0.5 + 0.5 * x, 0.5 + 0.5 * y);
    } else {
        /* A star of seven rays in a ring. */
        float a = atan(y, x);
        float ray = 0.40 + 0.30 * pow(abs(cos(3.5 * a)), 3);
        mark = mix(fieldcolor, ringcolor, smoothstep(0.80 - w, 0.80 + w, r));
        mark = mix(bodycolor, mark, smoothstep(ray - w, ray + w, r));
        mark = mix(fieldcolor, mark, smoothstep(0.16 - w, 0.16 + w, r));
    }
    Ct = mix(Ct, mark, inside);

    if (reportonce != 0) {
        string title = concat("emblem of ", shadername());
        debug(r);
        printf("%s\n", format("%s: size %f, turned %f, in %m", title, size, turn, emblem));
    }
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    float kr = 0.03 + 0.6 * pow(1 - clamp(-(Nf . In), 0, 1), 5);
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -In, 8 * roughness) +
               kr * trace(P, reflect(In, Nf)));
}
