"""tests/programs/shade/integrators_test.py: directlighting() and indirectspecular() of classes, over points and lights whose
sums are arithmetic by hand."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from points_test import Points
from programs import main

SUN = """light sun(uniform color tint = 1; uniform string __category = "";) {
    solar(vector "world" (0, 0, -1), 0) Cl = tint;
}"""
SLANT = """light slant(string __category = "key";) {
    solar(vector "world" (0, -0.8, -0.6), 0) Cl = color(0, 2, 0);
}"""
FRONT = {"P": [0, 0, 0], "N": [0, 0, 1], "I": [0, 0, -1]}
# "diffuse" is 0.5 x cosine / PI, "specular" the cosine squared / PI; lights of Cl are radiance PI x Cl.
CLASS = """class x(output varying color d = 9; output varying color g = 9; output varying color e = 9;
                output varying float n = 9;) {{
    {members}
    public void evaluateSamples(string what; output __radiancesample a[]) {{
        float i;
        for (i = 0; i < arraylength(a); i += 1) {{
            float c = max(0, a[i]->direction . normalize(N));
            if (what == "diffuse") a[i]->setMaterialResponse(0.5 * c / PI, 0);
            else if (what == "specular") a[i]->setMaterialResponse(c * c / PI, 1);
        }}
    }}
    public void generateSamples(string what; output __radiancesample a[]) {{
        __radiancesample made;
        made->setMaterialSamples(color 0.5, 2, normalize(vector(0, 0, 1)), 1e30);
        push(a, made);
        if (what == "indirectspecular") push(a, made);
    }}
    {methods}
}}"""


class Integrators(Points):
    def lit(self, methods, expected, members=""):
        self.check(CLASS.format(members=members, methods=methods),
                   {"variables": FRONT, "lights": [{"file": "sun.sl"}, {"file": "slant.sl"}]},
                   expected, sun=SUN, slant=SLANT)

    def test_results_are_sums_over_lights(self):
        d = [0.5, 0.5 * (1 + 2 * 0.6), 0.5]
        g = [1, 1 + 2 * 0.36, 1]
        self.lit("public void lighting(output color Ci, Oi) {"
                 " Ci = directlighting(this, getlights(), \"mis\", 1, \"heuristic\", \"veachpower2\","
                 " \"integrationdomain\", \"hemisphere\", \"diffuseresult\", d, \"specularresult\", g,"
                 " \"irradianceresult\", e); }",
                 {"d": [d], "g": [g], "e": [[1, 2.2, 1]], "Ci": [[a + b for a, b in zip(d, g)]]})

    def test_categories_choose_lights(self):
        self.lit("public void lighting(output color Ci, Oi) {"
                 " Ci = directlighting(this, getlights(\"category\", \"key\"), \"specularresult\", g);"
                 " directlighting(this, getlights(\"category\", \"-key\"), \"specularresult\", e); }",
                 {"g": [[0, 0.72, 0]], "e": [[1, 1, 1]]})

    def test_each_lighting_method_has_its_part(self):
        self.lit("public void diffuselighting(output color Ci, Oi) {"
                 " d = directlighting(this, getlights()); }"
                 "public void specularlighting(output color Ci, Oi) {"
                 " g = directlighting(this, getlights(), \"diffuseresult\", e); }",
                 {"d": [[0.5, 0.5 * 2.2, 0.5]],
                  "g": [[1, 1.72, 1]], "e": [[0, 0, 0]]})

    def test_results_may_be_members(self):
        self.lit("public void lighting(output color Ci, Oi) {"
                 " directlighting(this, getlights(), \"specularresult\", kept); }"
                 "public void postlighting(output color Ci, Oi) { Ci = kept; }",
                 {"Ci": [[1, 1.72, 1]]}, members="varying color kept = 0;")

    def test_material_samples_are_kept_for_the_indirect_light(self):
        self.lit("public void lighting(output color Ci, Oi) { __radiancesample a[];"
                 " directlighting(this, getlights(), \"materialsamples\", a); n = arraylength(a);"
                 " Ci = indirectspecular(this, \"materialsamples\", a) + a[0]->materialPdf; }",
                 {"n": [1], "Ci": [[2, 2, 2]]})  # rays meet nothing here: 0

    def test_samples_of_its_own(self):
        self.lit("public void lighting(output color Ci, Oi) {"
                 " Ci = indirectspecular(this, \"maxdist\", 10) + 1; }", {"Ci": [[1, 1, 1]]})


if __name__ == "__main__":
    main()
