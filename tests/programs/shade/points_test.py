"""tests/programs/shade/points_test.py: `kinora-shade run --points`, as shader libraries' own test suites
drive a renderer: points and variables in, numbers out. Expected numbers are arithmetic by hand."""
import json
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SOURCE, ProgramTest, main, shade

SQUARE = [[0, 0, 0], [2, 0, 0], [0, 3, 0], [2, 3, 0]]
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
GRID = (21, 11)
LAMP = """light lamp(float intensity = 2; color tint = 1; string __category = "key";) {
    illuminate(point "shader" (0, 0, 0)) Cl = intensity * tint / (L . L);
}"""
SUN = """light sun(uniform color tint = 1; uniform float level[2] = {3, 4};) {
    solar(vector "shader" (0, 0, -1), 0) Cl = tint;
}"""
CLASS_LAMP = """class lamp(float intensity = 8; vector down = vector(0, 0, -2);) {
    public void light(output vector L; output color Cl) { L = down; Cl = intensity / (L . L); }
}"""


def moved(x, y, z):
    return IDENTITY[:12] + [x, y, z, 1]


def grid_points(columns, rows, width, height):
    return [[width * c / (columns - 1), height * r / (rows - 1), 0]
            for r in range(rows) for c in range(columns)]


class Points(ProgramTest):
    def shade_points(self, text, document, *words, **files):
        for name, source in files.items():
            self.write(name + ".sl", source)
        shader = self.write("x.sl", text)
        points = self.write("points.json", json.dumps(document))
        return shade("run", shader, "--points", points, "--json", *words)

    def run_points(self, text, document, *words, **files):
        result = self.expect(self.shade_points(text, document, *words, **files), 0)
        return json.loads(result.out)

    def check(self, text, document, expected, *words, **files):
        got = self.run_points(text, document, *words, **files)
        for name, values in expected.items():
            self.assertIn(name, got)
            self.close(got[name], values, name)

    def close(self, got, wanted, where):
        if isinstance(wanted, (list, tuple)):
            self.assertEqual(len(got), len(wanted), where)
            for i, (g, w) in enumerate(zip(got, wanted)):
                self.close(g, w, f"{where}[{i}]")
        elif isinstance(wanted, float) or isinstance(wanted, int):
            self.assertLess(abs(got - wanted), 1e-5 * max(1, abs(wanted)), where)
        else:
            self.assertEqual(got, wanted, where)

    def wrong(self, document, *said, text="surface x(float Kd = 1; varying float w = 0;) {}",
              **files):
        self.expect(self.shade_points(text, document, **files), 2, *said)


class Variables(Points):
    def test_one_point_has_the_documented_values(self):
        self.check("surface x(output varying vector a = 0; output varying normal b = 0;"
                   " output varying point c = 0; output varying float d = 1;) {"
                   " a = dPdu + dPdv; b = Ng; c = E; d = s + t + u + v + du + dv + time; Ci = Cs; }",
                   {}, {"points": 1, "Ci": [[1, 1, 1]], "Oi": [[1, 1, 1]], "P": [[0, 0, 0]],
                        "N": [[0, 0, 1]], "a": [[0, 0, 0]], "b": [[0, 0, 1]], "c": [[0, 0, 0]],
                        "d": [0]})

    def test_points_normals_and_incident_rays_are_as_given(self):
        self.check("surface x() { Ci = color(P[0], N[1], I[2]); }",
                   {"variables": {"P": SQUARE, "N": [0, 2, 0], "I": [0, 0, 5]}},
                   {"Ci": [[0, 2, 5], [2, 2, 5], [0, 2, 5], [2, 2, 5]], "P": SQUARE,
                    "N": [[0, 2, 0]] * 4})

    def test_the_ray_goes_from_the_eye_to_the_point(self):
        self.check("surface x() { Ci = color(I); }", {"variables": {"P": [[1, 2, 3]]}},
                   {"Ci": [[1, 2, 3]]})
        self.check("surface x() { Ci = color(I); }",
                   {"variables": {"P": [[1, 2, 3]], "E": [1, 1, 1]}}, {"Ci": [[0, 1, 2]]})

    def test_texture_coordinates_one_a_point(self):
        self.check("surface x() { Ci = color(s, t, u + v); }",
                   {"variables": {"s": [0, 0.25, 1], "t": 0.5, "u": [1, 2, 3], "v": [4, 5, 6]}},
                   {"Ci": [[0, 0.5, 5], [0.25, 0.5, 7], [1, 0.5, 9]]})

    def test_s_and_t_follow_u_and_v(self):
        self.check("surface x() { Ci = color(s, t, 0); }", {"variables": {"u": [1, 2], "v": 3}},
                   {"Ci": [[1, 3, 0], [2, 3, 0]]})

    def test_surface_color_and_opacity(self):
        self.check("surface x() { Oi = Os; Ci = Cs * Oi; }",
                   {"variables": {"Cs": [[0.5, 1, 0], [1, 1, 1]], "Os": 0.5}},
                   {"Ci": [[0.25, 0.5, 0], [0.5, 0.5, 0.5]], "Oi": [[0.5] * 3] * 2})

    def test_uniform_user_variables(self):
        self.check("surface x(float Kd = 1; color tint = 1;) { Ci = Kd * tint; }",
                   {"points": 2, "variables": {"Kd": 0.5, "tint": [1, 2, 3]}},
                   {"Ci": [[0.5, 1, 1.5]] * 2})

    def test_varying_user_variables_of_each_type(self):
        self.check("surface x(varying float f = 0; varying color c = 0; varying point p = 0;"
                   " varying matrix m = 1; output varying float o = 0;) {"
                   " Ci = f * c; o = p[1] + comp(m, 3, 0); }",
                   {"points": 2,
                    "variables": {"f": [2, 3], "c": [[1, 2, 3], [4, 5, 6]], "p": [[0, 7, 0], [0, 8, 0]],
                                  "m": [IDENTITY, moved(10, 0, 0)]}},
                   {"Ci": [[2, 4, 6], [12, 15, 18]], "o": [7, 18]})

    def test_arrays_uniform_and_one_a_point(self):
        self.check("surface x(float a[3] = {0, 0, 0}; varying color b[2] = {0, 0};) {"
                   " Ci = b[1] * a[2]; }",
                   {"points": 2, "variables": {"a": [1, 2, 3], "b": [[[0, 0, 0], [1, 2, 3]],
                                                                     [[0, 0, 0], [4, 5, 6]]]}},
                   {"Ci": [[3, 6, 9], [12, 15, 18]]})

    def test_variables_go_before_parameters_before_defaults(self):
        text = "surface x(float a = 1, b = 1, c = 1;) { Ci = color(a, b, c); }"
        self.check(text, {"parameters": {"a": 2, "b": 2}, "variables": {"a": 3}},
                   {"Ci": [[3, 2, 1]]})
        self.check(text, {"parameters": {"b": 2}}, {"Ci": [[1, 7, 1]]}, "--param", "b=7")

    def test_parameters_that_decide_the_code(self):
        self.check("surface x(float count = 2; string mode = \"off\";) { float i, n = 0;"
                   " for (i = 0; i < count; i += 1) n += 1; Ci = mode == \"on\" ? n : 0; }",
                   {"parameters": {"count": 5, "mode": "on"}}, {"Ci": [[5, 5, 5]]})

    def test_points_among_parameters_are_in_shader_space(self):
        self.check("surface x(point a = point(1, 0, 0); vector d = vector(1, 0, 0);) {"
                   " Ci = color(a) + 10 * color(d); }",
                   {"spaces": {"shader": moved(0, 5, 0)}, "parameters": {"d": [0, 0, 1]}},
                   {"Ci": [[1, 5, 10]]})

    def test_points_among_variables_are_in_current_space(self):
        self.check("surface x(point a = 0;) { Ci = color(a); }",
                   {"spaces": {"shader": moved(0, 5, 0)}, "variables": {"a": [1, 2, 3]}},
                   {"Ci": [[1, 2, 3]]})


class Outputs(Points):
    def test_outputs_of_every_type(self):
        self.check("surface x(output varying float f = 0; output varying color c = 0;"
                   " output varying string w = \"\"; output varying float a[2] = {0, 0};"
                   " output matrix m = 1;) {"
                   " f = u; c = color(u, 0, 1); w = u > 1 ? \"high\" : \"low\"; a[1] = 2 * u; }",
                   {"variables": {"u": [1, 2]}},
                   {"f": [1, 2], "c": [[1, 0, 1], [2, 0, 1]], "w": ["low", "high"],
                    "a": [[0, 2], [0, 4]], "m": [IDENTITY] * 2})

    def test_what_is_not_finite_is_null(self):
        got = self.run_points("surface x(float zero = 0;) { Ci = color(1 / zero, log(-1 - zero), 1); }",
                              {})
        self.assertEqual(got["Ci"][0][2], 1)

    def test_a_surface_that_writes_P_and_N(self):
        self.check("surface x() { N = normal(1, 2, 3); }", {}, {"N": [[1, 2, 3]]})

    def test_a_class_s_members_reach_its_outputs(self):
        self.check("class x(output varying float o = 0;) { varying float m = 0;"
                   " public void begin() { m = 3 * u; }"
                   " public void surface(output color Ci, Oi) { o = m + 1; Ci = Oi; } }",
                   {"variables": {"u": [1, 2], "Os": 0.25}},
                   {"o": [4, 7], "Ci": [[0.25] * 3] * 2, "Oi": [[0.25] * 3] * 2})

    def test_every_target_prints_the_same(self):
        text = "surface x() { Ci = color noise(P * 3.7) + sqrt(s + 1); }"
        document = {"grid": GRID, "variables": {"P": grid_points(*GRID, 2, 1)}}
        runs = {self.shade_points(text, document, "--target", "interp").out,
                self.shade_points(text, document).out}
        self.assertEqual(len(runs), 1)
        self.assertIn('"points": 231', runs.pop())


class Grids(Points):
    def test_without_a_grid_derivatives_are_0(self):
        self.check("surface x(varying float w = 0;) {"
                   " Ci = color(Du(w), Dv(s), area(P)); Oi = color(Du(u), Dv(v), Dv(u)); }",
                   {"variables": {"P": SQUARE, "w": [1, 2, 3, 4], "u": [0, 1, 0, 1],
                                  "v": [0, 0, 1, 1]}},
                   {"Ci": [[0, 0, 0]] * 4, "Oi": [[1, 1, 0]] * 4})

    def test_edges_of_the_surface_are_as_given(self):
        self.check("surface x() { Ci = color(Du(P)); Oi = color(dPdv); }",
                   {"variables": {"dPdu": [1, 2, 3], "dPdv": [4, 5, 6]}},
                   {"Ci": [[1, 2, 3]], "Oi": [[4, 5, 6]], "N": [[c / math.sqrt(54) for c in
                                                                 (-3, 6, -3)]]})

    def test_edges_by_the_grid(self):
        points = grid_points(*GRID, 4, 2)
        self.check("surface x() { Ci = color(dPdu); Oi = color(dPdv); }",
                   {"grid": GRID, "variables": {"P": points}},
                   {"Ci": [[4, 0, 0]] * 231, "Oi": [[0, 2, 0]] * 231, "N": [[0, 0, 1]] * 231})

    def test_central_differences_inside_and_one_sided_at_the_edge(self):
        columns = GRID[0]
        w = [(i % columns) ** 2 for i in range(231)]  # Du of it: the mean of both slopes, by 1/20
        slope = [20 * (1 if c == 0 else 2 * 20 - 1 if c == 20 else 2 * c) for c in range(columns)]
        self.check("surface x(varying float w = 0; output varying float d = 0;) { d = Du(w); }",
                   {"grid": GRID, "variables": {"w": w}}, {"d": slope * 11})

    def test_changes_along_v(self):
        w = [3 * (i // 21) for i in range(231)]
        self.check("surface x(varying float w = 0;) { Ci = color(Du(w), Dv(w), Deriv(w, v)); }",
                   {"grid": GRID, "variables": {"w": w}}, {"Ci": [[0, 30, 30]] * 231})

    def test_u_v_and_their_steps_by_the_grid(self):
        got = self.run_points("surface x() { Ci = color(u, v, Du(u)); Oi = color(du, dv, Dv(v)); }",
                              {"grid": GRID})
        self.close(got["Ci"][0], [0, 0, 1], "first")
        self.close(got["Ci"][22], [0.05, 0.1, 1], "second row")
        self.close(got["Ci"][230], [1, 1, 1], "last")
        self.close(got["Oi"][115], [0.05, 0.1, 1], "steps")

    def test_derivatives_of_expressions(self):
        got = self.run_points("surface x() { Ci = color(Du(s * s), Dv(s * t), Du(sin(s))); }",
                              {"grid": GRID})
        s, t = 10 / 20, 5 / 10
        self.close(got["Ci"][5 * 21 + 10], [2 * s, s, math.cos(s)], "middle")

    def test_a_normal_by_the_grid(self):
        points = [[x, y, x] for x, y, _ in grid_points(3, 3, 1, 1)]
        self.check("surface x() { Ci = color(calculatenormal(P)); }",
                   {"grid": [3, 3], "variables": {"P": points}}, {"Ci": [[-1, 0, 1]] * 9})


class Spaces(Points):
    def test_unknown_spaces_are_current(self):
        self.check("surface x() { Ci = color(transform(\"paint\", P)); }",
                   {"variables": {"P": [[1, 2, 3]]}}, {"Ci": [[1, 2, 3]]})

    def test_spaces_by_name(self):
        self.check("surface x() { Ci = color(transform(\"paint\", P));"
                   " Oi = color(point \"paint\" (1, 1, 1)); }",
                   {"variables": {"P": [[1, 2, 3]]}, "spaces": {"paint": moved(10, 20, 30)}},
                   {"Ci": [[-9, -18, -27]], "Oi": [[11, 21, 31]]})

    def test_scaled_spaces_and_vectors(self):
        scale = [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 5, 5, 1]
        self.check("surface x() { Ci = color(vtransform(\"paint\", \"current\", vector(1, 2, 3))); }",
                   {"spaces": {"paint": scale}}, {"Ci": [[2, 4, 6]]})

    def test_object_and_world(self):
        self.check("surface x() { Ci = color(transform(\"object\", P));"
                   " Oi = color(transform(\"object\", \"world\", point(0, 0, 0))); }",
                   {"variables": {"P": [[0, 0, 0]]},
                    "spaces": {"object": moved(1, 0, 0), "world": moved(0, 1, 0)}},
                   {"Ci": [[-1, 0, 0]], "Oi": [[1, -1, 0]]})

    def test_a_space_named_at_run_time(self):
        self.check("surface x(varying float w = 0;) { string name = w > 0 ? \"a\" : \"b\";"
                   " Ci = color(transform(name, P)); }",
                   {"variables": {"w": [0, 1]}, "points": 2,
                    "spaces": {"a": moved(1, 0, 0), "b": moved(0, 1, 0)}},
                   {"Ci": [[0, -1, 0], [-1, 0, 0]]})


class Lights(Points):
    def test_without_lights_it_is_dark(self):
        self.check("surface x() { Ci = diffuse(N) + ambient(); }", {}, {"Ci": [[0, 0, 0]]})

    def test_a_lamp_by_its_place_and_parameters(self):
        self.check("surface x() { Ci = diffuse(N); }",
                   {"variables": {"P": [[0, 0, 0], [0, 0, 1]]},
                    "lights": [{"file": "lamp.sl", "space": moved(0, 0, 3),
                                "parameters": {"intensity": 9, "tint": [1, 2, 3]}}]},
                   {"Ci": [[1, 2, 3], [2.25, 4.5, 6.75]]}, lamp=LAMP)

    def test_several_lights_and_ambient(self):
        self.check("surface x() { Ci = ambient() + diffuse(N); }",
                   {"lights": [{"file": "sun.sl", "parameters": {"tint": 0.5}, "handle": "a"},
                               {"file": "sun.sl", "handle": "b"},
                               {"file": "glow.sl", "handle": "c"}]},
                   {"Ci": [[1.75] * 3]}, sun=SUN, glow="light glow() { Cl = 0.25; }")

    def test_categories(self):
        self.check("surface x() { Ci = 0; illuminance(\"key\", P) Ci += Cl;"
                   " illuminance(\"-key\", P) Ci += 10 * Cl; }",
                   {"lights": [{"file": "lamp.sl", "space": moved(0, 0, 1)}, {"file": "sun.sl"}]},
                   {"Ci": [[12] * 3]}, lamp=LAMP, sun=SUN)

    def test_light_parameters_as_messages(self):
        self.check("surface x(output varying float known = 0;) { Ci = 0; illuminance(P) {"
                   " color tint = 0; uniform float level[2] = {0, 0}; float none = 5;"
                   " known += lightsource(\"tint\", tint) + lightsource(\"level\", level)"
                   " + lightsource(\"none\", none); Ci += tint * level[1] + none; } }",
                   {"lights": [{"file": "sun.sl", "parameters": {"tint": [1, 2, 3]}}]},
                   {"Ci": [[9, 13, 17]], "known": [2]}, sun=SUN)

    def test_lights_at_other_positions(self):
        self.check("surface x() { Ci = 0; illuminance(P + vector(0, 0, 1)) Ci += Cl; }",
                   {"points": 3,
                    "lights": [{"file": "lamp.sl", "space": moved(0, 0, 3)}]},
                   {"Ci": [[0.5] * 3] * 3}, lamp=LAMP)

    def test_a_light_of_a_class(self):
        self.check("surface x() { Ci = diffuse(N); }", {"lights": [{"file": "lamp.sl"}]},
                   {"Ci": [[2] * 3]}, lamp=CLASS_LAMP)

    def test_a_light_by_itself(self):
        self.check(LAMP, {"variables": {"P": [[0, 0, 2], [0, 4, 0]]}},
                   {"L": [[0, 0, 2], [0, 4, 0]], "Cl": [[0.5] * 3, [0.125] * 3]})


class CoShaders(Points):
    LAYERED = """class x(shader base = null; shader layers[] = {}; output varying float n = 0;) {
        public void surface(output color Ci, Oi) {
            color c = 0; float i;
            if (base != null) base->tint(c);
            for (i = 0; i < arraylength(layers); i += 1) layers[i]->cover(c);
            Ci = c; n = arraylength(layers);
        }
    }"""
    CLAY = "class clay(color tone = color(1, 2, 3); varying float wet = 0;) {" \
           " public void tint(output color c) { c = tone * (1 + wet) + point \"shader\" (0, 0, 0)[0]; } }"
    COAT = "class coat(float gain = 2;) { public void cover(output color c) { c = gain * c + s; } }"
    FILES = [{"handle": "clay", "file": "clay.sl", "parameters": {"tone": [1, 1, 4]}},
             {"handle": "one", "file": "coat.sl"},
             {"handle": "two", "file": "coat.sl", "parameters": {"gain": 3}}]

    def check_layers(self, document, expected):
        self.check(self.LAYERED, document | {"coshaders": self.FILES}, expected,
                   clay=self.CLAY, coat=self.COAT)

    def test_are_called_by_the_handles_that_parameters_name(self):
        self.check_layers({"parameters": {"base": "clay", "layers": ["two", "one"]},
                           "variables": {"s": [0, 10]}},
                          {"n": [2, 2], "Ci": [[6, 6, 24], [36, 36, 54]]})

    def test_none_or_unknown_ones_are_null(self):
        self.check_layers({}, {"n": [0], "Ci": [[0] * 3]})
        self.check_layers({"parameters": {"base": "paint"}}, {"n": [0], "Ci": [[0] * 3]})

    def test_take_variables_of_the_points(self):
        self.check_layers({"points": 2, "parameters": {"base": "clay"}, "variables": {"wet": [0, 1]}},
                          {"Ci": [[1, 1, 4], [2, 2, 8]]})

    def test_are_found_by_handle_and_category(self):
        self.check("class x() { public void surface(output color Ci, Oi) {"
                   " shader a = getshader(\"one\"), all[] = getshaders(\"category\", \"cloth\");"
                   " Ci = color(a->value(), arraylength(all), getshader(\"three\") == null); } }",
                   {"coshaders": [{"handle": h, "file": "v.sl",
                                   "parameters": {"__category": "wool, cloth" if h == "two" else ""}}
                                  for h in ("one", "two")]},
                   {"Ci": [[7, 1, 1]]},
                   v="class v(string __category = \"\";) { public float value() { return 7; } }")

    def test_what_is_wrong_with_them(self):
        self.wrong({"coshaders": [{"file": "clay.sl"}]}, "coshaders[0]: needs a \"handle\"", clay=self.CLAY)
        self.wrong({"coshaders": self.FILES[:1] * 2}, "the handle 'clay' is taken", clay=self.CLAY)
        self.wrong({"coshaders": [self.FILES[0] | {"space": moved(1, 0, 0)}]},
                   "coshaders[0].space: a co-shader is in the space of the shader", clay=self.CLAY)
        result = self.shade_points(self.LAYERED, {"coshaders": self.FILES[:1],
                                                  "parameters": {"base": "clay", "clay.tne": 1}},
                                   clay=self.CLAY)
        self.expect(result, 2, "no parameter 'clay.tne'; did you mean 'clay.tone'?")


class Printing(Points):
    def test_goes_to_stderr_and_ends(self):
        result = self.shade_points("surface x() { printf(\"s %g\\n\", s); }", {"variables": {"s": [1, 2]}})
        self.expect(result, 0, "s 1\ns 2\n")
        result = self.shade_points("surface x() { printf(\"%g\\n\", s); }",
                                   {"points": 12000, "variables": {"s": 0.5}})
        self.expect(result, 0, "12000", "10000")
        self.assertEqual(result.err.count("0.5\n"), 10000)


class Queries(Points):
    def test_options_and_attributes_of_every_kind(self):
        self.check("surface x(output varying float known = 0; output varying string w = \"\";) {"
                   " float a = 0; color c = 0; string words[2] = {\"\", \"\"}; float list[3] = {0, 0, 0};"
                   " known = option(\"user:a\", a) + attribute(\"user:c\", c)"
                   " + attribute(\"user:words\", words) + option(\"user:list\", list);"
                   " Ci = a * c + list[2]; w = words[1]; }",
                   {"options": {"user:a": 2, "user:list": [1, 2, 3]},
                    "attributes": {"user:c": [1, 2, 3], "user:words": ["one", "two"]}},
                   {"known": [4], "Ci": [[5, 7, 9]], "w": ["two"]})

    def test_unknown_ones_and_other_types_are_0_and_leave_the_variable(self):
        self.check("surface x(output varying float known = 0;) { float a = 7; string s = \"\";"
                   " known = option(\"user:none\", a) + attribute(\"user:c\", a)"
                   " + option(\"user:a\", s); Ci = a; }",
                   {"options": {"user:a": 2}, "attributes": {"user:c": [1, 2, 3]}},
                   {"known": [0], "Ci": [[7] * 3]})

    def test_facts_of_a_camera_ray_and_of_the_file(self):
        self.check("surface x(output varying string t = \"\"; output varying float d = 9;) {"
                   " rayinfo(\"type\", t); rayinfo(\"depth\", d); }", {},
                   {"t": ["camera"], "d": [0]})
        self.check("surface x(output varying string t = \"\"; output varying float d = 9;) {"
                   " rayinfo(\"type\", t); rayinfo(\"depth\", d); }",
                   {"rayinfo": {"type": "diffuse", "depth": 3}}, {"t": ["diffuse"], "d": [3]})


class Displacements(Points):
    BUMP = """displacement bump(float amount = 1; output varying float height = 0;) {
        height = amount * s;
        P += height * normalize(N);
        N = calculatenormal(P);
    }"""

    def test_points_are_moved_before_the_surface(self):
        self.check("surface x() { Ci = color(P); }",
                   {"variables": {"s": [0, 1], "N": [0, 0, 2]}, "points": 2,
                    "displacement": {"file": "bump.sl", "parameters": {"amount": 3}}},
                   {"P": [[0, 0, 0], [0, 0, 3]], "Ci": [[0, 0, 0], [0, 0, 3]], "height": [0, 3]},
                   bump=self.BUMP)

    def test_normals_follow_on_a_grid(self):
        self.check("surface x() { Ci = color(dPdu); }",
                   {"grid": [3, 3], "variables": {"P": grid_points(3, 3, 2, 2)},
                    "displacement": {"file": "bump.sl", "parameters": {"amount": 4}}},
                   {"Ci": [[2, 0, 4]] * 9, "N": [[-8, 0, 4]] * 9}, bump=self.BUMP)

    def test_a_displacement_by_itself(self):
        self.check(self.BUMP, {"variables": {"s": 0.5}},
                   {"P": [[0, 0, 0.5]], "height": [0.5]})


class Wrong(Points):
    def test_lengths(self):
        self.wrong({"variables": {"P": SQUARE, "N": [[0, 0, 1]] * 3}}, "N: a normal takes",
                   "a list of 4 lists of 3 numbers", "this is a list of 3 lists of 3 numbers")
        self.wrong({"variables": {"P": SQUARE, "w": [1, 2, 3]}}, "w: a float takes a number, or one "
                   "a point: a list of 4 numbers; this is a list of 3 numbers")
        self.wrong({"grid": [3, 2], "variables": {"P": SQUARE}}, "P: a point takes")
        self.wrong({"grid": [3, 2], "points": 5}, "points: 5, but the grid of 3 x 2 has 6")
        self.wrong({"variables": {"P": SQUARE, "foo": [1, 2]}}, "foo: a list of 2 numbers for 4")

    def test_empty_and_uneven_lists(self):
        self.wrong({"variables": {"P": []}}, "variables.P: an empty list")
        self.wrong({"variables": {"P": [[0, 0, 0], [0, 0]]}}, "a list of 2 stands among lists of 3")
        self.wrong({"variables": {"P": [[0, 0, 0], 1]}}, "not equally deep")
        self.wrong({"variables": {"Kd": {"value": 1}}}, "a object stands where")

    def test_types(self):
        self.wrong({"variables": {"Kd": "red"}}, "Kd: a float takes a number", "this is a text")
        self.wrong({"points": 2, "variables": {"Kd": [1, 2]}}, "uniform parameter",
                   "declare it 'varying float'")
        self.wrong({"variables": {"time": [1, 2]}, "points": 2}, "time: has one value")

    def test_names(self):
        self.wrong({"parameters": {"kd": 1}}, "no parameter 'kd'; did you mean 'Kd'?")
        self.wrong({"varables": {}}, "'varables' is not known; did you mean 'variables'?")
        self.wrong({"lights": [{"fil": "a.sl"}]}, "'lights[0].fil' is not known")
        result = self.shade_points("surface x(varying float weight = 0;) { Ci = weight; }",
                                   {"variables": {"wieght": 1}})
        self.expect(result, 0, "no shader reads the variable 'wieght'; did you mean 'weight'?")

    def test_shaders_and_spaces(self):
        self.wrong({"lights": [{"handle": "a"}]}, "needs a \"file\"")
        self.wrong({"lights": [{"file": "lamp.sl", "handle": "a"}] * 2}, "'a' is taken", lamp=LAMP)
        self.wrong({"displacement": {"file": "lamp.sl"}}, "'lamp' is a light shader", lamp=LAMP)
        self.wrong({"spaces": {"a": [0] * 16}}, "spaces.a: the matrix has no inverse")
        self.wrong({"spaces": {"a": [1, 2]}}, "spaces.a: takes the 16 numbers")

    def test_files(self):
        shader = self.write("x.sl", "surface x() {}")
        self.expect(shade("run", shader, "--points", self.folder / "none.json"), 2, "cannot be read")
        self.expect(shade("run", shader, "--points", self.write("a.json", "{\"points\": }")), 2,
                    "is no JSON")
        self.expect(shade("run", shader, "--json"), 2, "--points")
        self.expect(shade("run", shader, "--points", "a.json", "-o", "a.png"), 2, "leave")

    def test_a_light_with_errors_has_their_place(self):
        self.write("bad.sl", "light bad() { Cl = colr; }")
        shader = self.write("x.sl", "surface x() {}")
        points = self.write("points.json", json.dumps({"lights": [{"file": "bad.sl"}]}))
        self.expect(shade("run", shader, "--points", points), 4, "bad.sl:1:20: error")


class Example(Points):
    def test_the_one_of_the_documentation(self):
        page = (SOURCE / "docs/shade.md").read_text()
        page = page[page.index("## Points"):]
        shader, document, printed = re.findall(r"```(?:c|json)\n(.*?)```", page, re.S)[:3]
        got = self.run_points(shader, json.loads(document),
                              spot="light spot(float intensity = 1;) "
                                   "{ illuminate(point \"shader\" (0, 0, 0)) Cl = intensity; }")
        for name, values in json.loads(printed).items():
            self.close(got[name], values, name)


if __name__ == "__main__":
    main()
