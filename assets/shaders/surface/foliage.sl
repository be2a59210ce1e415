/* foliage.sl: cut-out leaves with veins, as a class: opacity() runs first, so that nothing is shaded
   between the leaves.
   Parameters: serial (a number and a name, which vary the leaf), count of veins, green, vein, Kd. */
struct Blade {
    varying float along = 0;   // from the stem to the tip
    varying float across = 0;  // from the middle to the edge
    void init(float x; float y) {
        along = mod(y, 1);
        across = abs(mod(x, 1) - 0.5) * 2;
    }
    // Half the width at this height.
    float reach(float teeth) {
        float width = 1.6 * sqrt(along) * (1 - along);
        return width * (1 - 0.06 * abs(sin(along * teeth)));
    }
}
class foliage(string serial = "7 oak"; float count = 9; float Kd = 0.9;
              color green = color(0.16, 0.42, 0.08); color vein = color(0.55, 0.65, 0.25);) {
    uniform float number = 0;
    Blade blade;
    float veins[];

    public void construct() {
        string label = sprintf("%s/%d", serial, count);
        number = stof(serial) + strlen(label);
    }
    public void begin() {
        uniform float k;
        blade->init(s * 4, t * 4);
        reserve(veins, 24);
        resize(veins, 1);
        for (k = 1; k <= min(count, capacity(veins) - 2); k += 1)
            push(veins, (k - 0.5 + 0.2 * cellnoise(k, number)) / count);
    }
    public void opacity(output color Oi) {
        Oi = Os * step(blade->across, blade->reach(number * 4));
    }
    public void surface(output color Ci, Oi) {
        float lines = 1 - smoothstep(0.02, 0.05, blade->across);
        uniform float k;
        float tip = pop(veins);
        for (k = 0; k < arraylength(veins); k += 1) {
            float away = abs(blade->along - veins[k] - 0.12 * blade->across);
            lines = max(lines, 0.7 * (1 - smoothstep(0.008, 0.02, away)));
        }
        color tint = mix(green, vein, lines) * (1 - 0.2 * smoothstep(tip, 1, blade->along));
        float detail = 1;
        if (isindirectray() == 0) detail = 0.85 + 0.3 * noise(s * 160, t * 160);
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * tint * detail * Kd * (ambient() + diffuse(Nf) + 0.4 * diffuse(-Nf));
    }
}
