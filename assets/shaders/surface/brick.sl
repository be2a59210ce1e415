/* brick.sl: a wall of fired bricks in running bond, in the manner of 1990: macros, no functions.
   World units: the wall is laid on whatever plane a surface lies in.
   Parameters: brickwidth, brickheight, mortarwidth (world units), the colours of brick and mortar,
   jagged (how crooked the edges are), variation of the firing from brick to brick. */
#define MIXED(a, b, x) ((a) + ((b) - (a)) * (x))
#define WIDTH_OF(x) max(abs(Du(x) * du) + abs(Dv(x) * dv), 0.0001)
#define BOXSTEP(a, b, x) clamp(((x) - (a)) / ((b) - (a)), 0, 1)
#define UP(a, x) BOXSTEP((a) - 0.5 * w, (a) + 0.5 * w, (x))

surface
brick(float Ka = 1, Kd = 0.85, brickwidth = 0.42, brickheight = 0.16, mortarwidth = 0.026,
      jagged = 0.012, variation = 0.5;
      color brickcolor = color(0.50, 0.17, 0.09), burntcolor = color(0.22, 0.09, 0.075),
            mortarcolor = color(0.55, 0.52, 0.47);)
{
    normal Nf;
    point Q;
    float x, y, row, col, w, edge, inbrick, tone, grit;
    color Ct;

    Nf = faceforward(normalize(N), I);
    Q = transform("world", P);
    Nf = faceforward(normalize(N), I);

    /* The plane of the wall: the two axes that its normal leaves. */
    normal Nw = ntransform("world", Nf);
    if (abs(zcomp(Nw)) > 0.7 * length(Nw)) {
        x = xcomp(Q);
        y = ycomp(Q);
    } else {
        vector along = normalize(vector(-ycomp(Nw), xcomp(Nw), 0));
        x = along . (Q - point(0, 0, 0));
        y = zcomp(Q);
    }
    x += jagged * (float noise(14 * Q) - 0.5) * 2;
    y += jagged * (float noise(14 * Q + vector(5, 7, 2)) - 0.5) * 2;

    x /= brickwidth;
    y /= brickheight;
    row = floor(y);
    if (mod(row, 2) >= 1)
        x += 0.5;
    col = floor(x);

    /* Distance from the nearest joint, in world units. */
    edge = min((0.5 - abs(x - col - 0.5)) * brickwidth, (0.5 - abs(y - row - 0.5)) * brickheight);
    w = WIDTH_OF(edge);
    w = min(w, 4 * mortarwidth);
    inbrick = UP(0.5 * mortarwidth, edge);

    tone = float cellnoise(col + 0.5, row + 0.5);
    grit = float noise(60 * Q) + 0.5 * float noise(131 * Q);
    Ct = MIXED(brickcolor, burntcolor, variation * tone * tone);
    Ct *= 0.72 + 0.3 * grit + 0.25 * (float cellnoise(col + 7.5, row + 3.5) - 0.5);
    Ct = mix(mortarcolor * (0.75 + 0.3 * grit), Ct, inbrick);
    /* Soot gathers in the joints. */
    Ct *= MIXED(0.55, 1, smoothstep(0.2 * mortarwidth, 1.6 * mortarwidth, edge));

    Oi = Os;
    Ci = Os * Cs * Ct * (Ka * ambient() + Kd * diffuse(Nf));
}
