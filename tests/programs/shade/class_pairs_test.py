"""tests/programs/shade/class_pairs_test.py: ten looks as a shader of RSL 1.x and as a class give the same
numbers, and a class without any one of its methods gives others."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from points_test import SUN, Points, grid_points
from programs import main

HEAD = "{}(float Kd = 0.8, Ks = 0.4, roughness = 0.2; color tint = color(0.8, 0.4, 0.2);) {{\n{}\n}}"
NF = "normal Nf = faceforward(normalize(N), I);"
SURFACE = "public void surface(output color Ci, Oi) {"
LIGHTING = "public void lighting(output color Ci, Oi) {"
PRE = "public void prelighting(output color Ci, Oi) {"
# Name: what both have, the body of the 1.x shader, the methods of the class.
PAIRS = {
    "matte": (NF + "Oi = Os; Ci = Os * tint * Kd * diffuse(Nf);",
              "normal Nf = 0; public void begin() { Nf = faceforward(normalize(N), I); }\n"
              + LIGHTING + "Ci = Oi * tint * Kd * diffuse(Nf); }"),
    "plastic": (NF + "Oi = Os; Ci = Os * (tint * Kd * diffuse(Nf)"
                " + Ks * specular(Nf, -normalize(I), roughness));",
                "public void diffuselighting(output color Ci, Oi) {" + NF +
                "Ci = tint * Kd * diffuse(Nf); }\n"
                "public void specularlighting(output color Ci, Oi) {" + NF +
                "Ci = Oi * (Ci + Ks * specular(Nf, -normalize(I), roughness)); }"),
    "cutout": (NF + "float c = mod(s * 5, 1) < 0.5 ? 0.75 : 0; Oi = c;"
               "Ci = Oi * tint * diffuse(Nf);",
               "public void opacity(output color Oi) { Oi = mod(s * 5, 1) < 0.5 ? 0.75 : 0; }\n"
               + SURFACE + NF + "Ci = Oi * tint * diffuse(Nf); }"),
    "bent": ("N = normalize(N + 0.3 * normal(sin(9 * s), cos(7 * t), 0));" + NF +
             "Oi = Os; Ci = Os * tint * diffuse(Nf);",
             "public void displacement(output point P; output normal N) {"
             " N = normalize(N + 0.3 * normal(sin(9 * s), cos(7 * t), 0)); }\n"
             + SURFACE + NF + "Oi = Os; Ci = Os * tint * diffuse(Nf); }"),
    "rings": (NF + "float r = mod(12 * sqrt(s * s + t * t), 1);"
              "Oi = Os; Ci = Os * mix(tint, tint * 0.4, r) * diffuse(Nf);",
              "float ring = 0;\n"
              "float wood(float x, y) { return mod(12 * sqrt(x * x + y * y), 1); }\n"
              "public void begin() { ring = wood(s, t); }\n"
              + SURFACE + NF + "Ci = Oi * mix(tint, tint * 0.4, ring) * diffuse(Nf); }"),
    "edges": (NF + "float f = pow(1 - abs(Nf . normalize(I)), 2); Oi = Os;"
              "Ci = Os * (tint * diffuse(Nf) + f);",
              "struct Rim { float f = 0; void init() {" + NF +
              " f = pow(1 - abs(Nf . normalize(I)), 2); } }\nRim rim;\n" + PRE + "rim->init(); }\n"
              + LIGHTING + NF + "Ci = Oi * (tint * diffuse(Nf) + rim->f); }"),
    "bricks": (NF + "float row = floor(t * 6), x = mod(s * 4 + 0.5 * mod(row, 2), 1),"
               " y = mod(t * 6, 1); color c = x < 0.1 || y < 0.15 ? color 0.6 : tint;"
               "Oi = Os; Ci = Os * c * diffuse(Nf);",
               "color base = 0;\n" + PRE + "float row = floor(t * 6), y = mod(t * 6, 1);"
               "float x = mod(s * 4 + 0.5 * mod(row, 2), 1);"
               "base = x < 0.1 || y < 0.15 ? color 0.6 : tint; }\n"
               + LIGHTING + NF + "Ci = base * diffuse(Nf); }\n"
               "public void postlighting(output color Ci, Oi) { Ci *= Oi; }"),
    "ramp": (NF + "color c = t < 0.25 ? color(1, 0, 0) : t < 0.5 ? color(0, 1, 0)"
             " : t < 0.75 ? color(0, 0, 1) : color(1, 1, 0); Oi = Os; Ci = c * Os;",
             "uniform color table[];\n"
             "public void construct() { push(table, color(1, 0, 0)); push(table, color(0, 1, 0));"
             " push(table, color(0, 0, 1)); push(table, color(1, 1, 0)); }\n"
             + SURFACE + "Ci = table[min(3, floor(4 * t))] * Oi; }"),
    "toon": ("color c = 0;" + NF + "illuminance(P, Nf, PI / 2)"
             " c += Cl * floor(3 * (normalize(L) . Nf)) / 3; Oi = Os; Ci = Os * tint * c;",
             "color steps(normal n) { color c = 0; illuminance(P, n, PI / 2)"
             " c += Cl * floor(3 * (normalize(L) . n)) / 3; return c; }\n"
             + SURFACE + NF + "Ci = Oi * tint * this->steps(Nf); }"),
    "veil": ("float v = abs(sin(20 * s)) * abs(sin(20 * t)); Oi = v * Os;"
             "Ci = Oi * (tint + v);",
             "float v = 0;\npublic void opacity(output color Oi) {"
             " v = abs(sin(20 * s)) * abs(sin(20 * t)); Oi *= v; }\n"
             + SURFACE + "Ci = Oi * (tint + v); }"),
}
METHOD = re.compile(r"^(?:public void|float|color) (\w+)\(.*\}$", re.M)
DOCUMENT = {"points": 231, "grid": [21, 11],
            "variables": {"P": grid_points(21, 11, 2, 1), "Os": [[0.9, 0.8, 0.7]] * 231,
                          "I": [[0.3, 0.1, -1]] * 231, "N": [[(7 * k % 11 - 5) / 8, (k % 21 - 10) / 12, 1] for k in range(231)],
                          "s": [p[0] / 2 for p in grid_points(21, 11, 2, 1)],
                          "t": [p[1] for p in grid_points(21, 11, 2, 1)]},
            "lights": [{"file": "sun.sl", "parameters": {"tint": [1, 0.5, 0.25]}}]}


class ClassPairs(Points):
    def numbers(self, source):
        got = self.run_points(source, DOCUMENT, sun=SUN)
        return [x for name in ("Ci", "Oi") for c in got[name] for x in c]

    def difference(self, methods, name, expected):
        got = self.numbers(HEAD.format("class " + name, methods))
        return max(abs(a - b) for a, b in zip(got, expected, strict=True))

    def test_the_same_numbers_and_others_without_a_method(self):
        self.assertEqual(len(PAIRS), 10)
        for name, (plain, methods) in PAIRS.items():
            expected = self.numbers(HEAD.format("surface " + name, plain))
            self.assertGreater(len(set(expected)), 3, name)
            self.assertLess(self.difference(methods, name, expected), 1e-6, name)
            for found in METHOD.finditer(methods):
                if found[0].startswith("public"):
                    less = methods.replace(found[0], "")
                    if re.search(r"void (surface|\w*lighting|opacity)\(", less):
                        self.assertGreater(self.difference(less, name, expected), 1e-3,
                                           f"{name} without {found[1]}()")


if __name__ == "__main__":
    main()
