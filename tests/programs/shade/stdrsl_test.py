"""tests/programs/shade/stdrsl_test.py: the headers of stdrsl, each by a shader over points of its own,
against arithmetic by hand."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from points_test import Points
from programs import main

HEAD = "#include <stdrsl/{}>\nsurface x(varying vector w = vector(0, 0, 1);" \
       " output varying float pdf = 0; output varying float n = 0;) {{\n" \
       "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5);\n" \
       "__radiancesample a[]; resize(a, 1); a[0]->direction = normalize(w); a[0]->distance = 1e30;\n{} }}"
FRONT = {"P": [0, 0, 0], "I": [0, 0, -1], "dPdu": [1, 0, 0], "dPdv": [0, 1, 0]}


class Stdrsl(Points):
    def lobe(self, header, body, variables, expected):
        self.check(HEAD.format(header, body), {"variables": FRONT | variables}, expected)

    def test_shading_context(self):
        self.check("#include <stdrsl/ShadingContext.h>\nsurface x(output varying vector t = 0;"
                   " output varying vector b = 0; output varying float e = 0;) {"
                   " stdrsl_ShadingContext c; c->construct(); c->init(); t = c->m_Tangent;"
                   " b = c->m_Bitangent; e = c->m_EnteringRegion; Ci = color(c->m_Ns);"
                   " Oi = color(c->m_Vn); }",
                   {"variables": {"P": [0, 0, 0], "I": [0, 0, -2], "N": [0, 0, 3],
                                  "dPdu": [2, 0, 0]}},
                   {"Ci": [[0, 0, 1]], "Oi": [[0, 0, 1]], "t": [[1, 0, 0]], "b": [[0, 1, 0]],
                    "e": [1]})

    def test_fresnel(self):
        self.lobe("Fresnel.h", "Ci = f->m_Kr; f->initSchlick(c, 1, 0, 0.1); Oi = f->m_Kr;",
                  {}, {"Ci": [[0.04] * 3], "Oi": [[0.1] * 3]})

    def test_lambert(self):
        self.lobe("Lambert.h", "stdrsl_Lambert d; d->init(color(1, 0.5, 0.25));"
                  "d->evalDiffuseSamps(c, f, a); Ci = a[0]->materialResponse;",
                  {"w": [0, math.sqrt(0.75), 0.5]},  # 60 degrees off; Fresnel lets 0.96 through
                  {"Ci": [[0.96 * 0.5 / math.pi * k for k in (1, 0.5, 0.25)]]})

    def test_oren_nayar(self):
        A = 1 - 0.5 * 0.25 / (0.25 + 0.33)  # seen along the normal the second term is 0
        self.lobe("OrenNayar.h", "stdrsl_OrenNayar d; d->init(1, 0.5);"
                  "d->evalDiffuseSamps(c, f, a); Ci = a[0]->materialResponse;", {},
                  {"Ci": [[0.96 / math.pi * A] * 3]})

    def test_specular_as(self):
        body = "stdrsl_SpecularAS d; d->init(c, color(1, 0.5, 0.25), 0.5, {}, 1, 1, 1);" \
               "d->evalSpecularSamps(c, f, a); Ci = a[0]->materialResponse;" \
               "pdf = a[0]->materialPdf;"
        self.lobe("SpecularAS.h", body.format(0), {},  # exponents 4; all cosines 1
                  {"Ci": [[5 / (8 * math.pi) * k for k in (1, 0.5, 0.25)]],
                   "pdf": [5 / (8 * math.pi)]})
        # Half vectors at 30 degrees along u and along v; roughness 0.75 and 0.25.
        nu, nv = 1 / 0.75 ** 2, 16
        top, ch, cl = math.sqrt((nu + 1) * (nv + 1)), math.cos(math.pi / 6), 0.5
        for w, power in (([math.sqrt(0.75), 0, 0.5], nu), ([0, math.sqrt(0.75), 0.5], nv)):
            lobe = top * ch ** power
            response = lobe / (8 * math.pi) * cl / (ch * 1)
            self.lobe("SpecularAS.h", body.format(0.5), {"w": w},
                      {"Ci": [[response * k for k in (1, 0.5, 0.25)]],
                       "pdf": [lobe / (2 * math.pi) / (4 * ch)]})

    def test_specular_blinn(self):
        body = "stdrsl_SpecularBlinn d; d->init(c, 1, 0.5, 1, 1); d->evalSpecularSamps(c, f, a);" \
               "Ci = a[0]->materialResponse; pdf = a[0]->materialPdf;"
        self.lobe("SpecularBlinn.h", body, {}, {"Ci": [[6 / (8 * math.pi)] * 3],
                                                "pdf": [5 / (8 * math.pi)]})
        ch = math.cos(math.pi / 6)  # at 60 degrees the masking is 1: 2 ch 0.5 / ch
        self.lobe("SpecularBlinn.h", body, {"w": [0, math.sqrt(0.75), 0.5]},
                  {"Ci": [[6 * ch ** 4 / (8 * math.pi)] * 3],
                   "pdf": [5 * ch ** 4 / (8 * math.pi * ch)]})

    def test_generated_samples_have_the_pdf_that_evaluating_gives(self):
        for header, struct, call in (("SpecularAS.h", "SpecularAS", "Cs, 0.3, 0.4, 1, 64, 64"),
                                     ("SpecularBlinn.h", "SpecularBlinn", "Cs, 0.3, 64, 64"),
                                     ("SpecularDBRDF.h", "SpecularDBRDF",
                                      "\"beckmann\", Cs, 0.4, 64, 64")):
            text = HEAD.format(header, f"stdrsl_{struct} d; d->init(c, {call}); resize(a, 0);"
                               "d->genSpecularSamps(c, f, \"specular\", a); float i, sum = 0;"
                               "n = arraylength(a); for (i = 0; i < n; i += 1)"
                               " sum += comp(a[i]->materialResponse, 0) / a[i]->materialPdf;"
                               "Ci = sum / 64; float p = a[3]->materialPdf;"
                               "d->evalSpecularSamps(c, f, a); pdf = a[3]->materialPdf - p;")
            got = self.run_points(text, {"points": 400, "variables": FRONT})
            self.close(got["pdf"], [0] * 400, "pdf")
            # What the lobe reflects: by numbers on the sphere of directions.
            mean = sum(c[0] for c in got["Ci"]) / 400
            steps, total = 200, 0
            rows = []
            for k in range(steps):
                z = (k + 0.5) / steps
                for m in range(32):
                    angle = (m + 0.5) / 32 * 2 * math.pi
                    r = math.sqrt(1 - z * z)
                    rows.append([r * math.cos(angle), r * math.sin(angle), z])
            even = self.run_points(
                HEAD.format(header, f"stdrsl_{struct} d; d->init(c, {call});"
                            "d->evalSpecularSamps(c, f, a); Ci = a[0]->materialResponse;"),
                {"points": len(rows), "variables": FRONT | {"w": rows}})
            total = sum(c[0] for c in even["Ci"]) / len(rows) * 2 * math.pi
            self.assertLess(abs(mean - total), 0.01 * total, struct)

    def test_specular_dbrdf(self):
        body = "stdrsl_SpecularDBRDF d; d->init(c, \"{}\", color(1, 0.5, 0.25), 0.5, 1, 1);" \
               "d->evalSpecularSamps(c, f, a); Ci = a[0]->materialResponse;" \
               "pdf = a[0]->materialPdf;"
        beckmann = 1 / (math.pi * 0.25)  # all cosines 1: p / 4 of both
        self.lobe("SpecularDBRDF.h", body.format("beckmann"), {},
                  {"Ci": [[beckmann / 4 * k for k in (1, 0.5, 0.25)]], "pdf": [beckmann / 4]})
        blinn = 5 / (2 * math.pi)  # the exponent is 4
        self.lobe("SpecularDBRDF.h", body.format("blinn"), {},
                  {"Ci": [[blinn / 4 * k for k in (1, 0.5, 0.25)]], "pdf": [blinn / 4]})
        # 60 degrees off: h at 30, p / (4 (0.5 + 1 - 0.5)) x 0.5, pdf p / (4 cos 30).
        c = math.cos(math.pi / 6)
        p = math.exp(-(1 / c ** 2 - 1) / 0.25) / (math.pi * 0.25 * c ** 3)
        self.lobe("SpecularDBRDF.h", body.format("beckmann"), {"w": [0, math.sqrt(0.75), 0.5]},
                  {"Ci": [[p / 8 * k for k in (1, 0.5, 0.25)]], "pdf": [p / (4 * c)]})

    def test_isotropic_volume(self):
        self.lobe("IsotropicVolume.h", "stdrsl_IsotropicVolume d; d->init(color(1, 0.5, 0.25));"
                  "d->evalDiffuseSamps(c, f, a); Ci = a[0]->materialResponse;", {"w": [0, 1, -1]},
                  {"Ci": [[k / (4 * math.pi) for k in (1, 0.5, 0.25)]]})

    def test_area_sampler(self):
        body = "stdrsl_AreaSampler l; a[0]->radiance = 7; l->evaluateSamples(P, \"{}\", a);" \
               "Ci = a[0]->radiance; pdf = a[0]->lightPdf; n = a[0]->distance;"

        def meets(shape, P, w, expected, space=None):
            document = {"variables": FRONT | {"P": P, "w": w}}
            if space:
                document["spaces"] = {"shader": space}
            self.check(HEAD.format("AreaSampler.h", body.format(shape)), document, expected)

        meets("rect", [0, 0, 2], [0, 0, -1], {"Ci": [[0.5, 0.5, 0]], "pdf": [4], "n": [2]})
        meets("rect", [0.25, -0.25, -2], [0, 0, 1],  # from behind
              {"Ci": [[0.75, 0.25, 0]], "pdf": [-4], "n": [2]})
        meets("rect", [0.6, 0, 2], [0, 0, -1], {"Ci": [[7] * 3], "pdf": [0], "n": [1e30]})
        meets("disc", [0.25, 0, 2], [0, 0, -1],
              {"Ci": [[0, 0.25, 0]], "pdf": [4 / (math.pi / 4)], "n": [2]})
        meets("sphere", [0, 0, 2], [0, 0, -1],
              {"Ci": [[0, 0, 0]], "pdf": [1.5 ** 2 / math.pi], "n": [1.5]})
        scaled = [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 1, 1]  # twice as large, at z = 1
        meets("rect", [0, 0, 4], [0, 0, -1], {"Ci": [[0.5, 0.5, 0]], "pdf": [9 / 4], "n": [3]},
              scaled)

    def test_area_samples_cover_the_solid_angle(self):
        body = "stdrsl_AreaSampler l; l->generateSamples(P, \"{}\", 64, a); float i, sum = 0;" \
               "for (i = 0; i < 64; i += 1) sum += a[i]->lightPdf > 0 ? 1 / a[i]->lightPdf : 0;" \
               "Ci = sum / 64; float p = a[5]->lightPdf; vector r = vector(a[5]->radiance);" \
               "a[5]->distance = 1e30; l->evaluateSamples(P, \"{}\", a);" \
               "pdf = p > 0 && p < 12 ? a[5]->lightPdf / p - 1 : 0;" \
               "n = p > 0 && p < 12 ? distance(point(r), point(vector(a[5]->radiance))) : 0;"
        disc = 2 * math.pi * (1 - 2 / math.sqrt(4.25))
        sphere = 2 * math.pi * (1 - math.sqrt(1 - 0.0625))
        for shape, angle in (("disc", disc), ("sphere", sphere)):
            got = self.run_points(HEAD.format("AreaSampler.h", body.format(shape, shape)),
                                  {"points": 400, "variables": FRONT | {"P": [0, 0, 2]}})
            mean = sum(c[0] for c in got["Ci"]) / 400
            self.assertLess(abs(mean - angle), 0.02 * angle, shape)
            self.assertLess(max(map(abs, got["pdf"])), 1e-3, shape)
            self.assertLess(max(got["n"]), 1e-2, shape)

    def test_hair(self):
        body = "c->initHair(0); stdrsl_Hair h; h->initDiffuse(c, 2, 1, 0.5, color(1, 0, 0)," \
               " color(0, 1, 0)); h->initSpecular(c, 1, 0, 0, 0.2, 1, 1.5);" \
               "h->evalDiffuseSamps(c, a); Ci = a[0]->materialResponse;" \
               "h->evalSpecularSamps(c, a); Oi = a[0]->materialResponse;"
        # Hair along y, light from the viewer; a quarter of the way to the tip.
        self.lobe("Hair.h", body, {"v": 0.25},
                  {"Ci": [[2 / math.pi * 0.75, 2 / math.pi * 0.25, 0]],
                   "Oi": [[0.04 * 0.25 / (0.2 * math.sqrt(2 * math.pi))] * 3]})
        self.lobe("Hair.h", body, {"v": 0, "w": [0, 0, -1]},  # through it
                  {"Ci": [[1 / math.pi, 0, 0]], "Oi": [[0] * 3]})

    def test_colors_math_sample_counts(self):
        self.check("#include <stdrsl/Colors.h>\n#include <stdrsl/Math.h>\n"
                   "#include <stdrsl/SampleMgr.h>\n surface x() { stdrsl_SampleMgr m; float n = 0;"
                   " m->computeDepthBasedSampleReduction(1, 64, 4, 1, n);"
                   " Ci = srgbToLinear(color(0.5, 1, 0)); Oi = color(n, M_TWOPI, M_INVPI); }", {},
                   {"Ci": [[((0.5 + 0.055) / 1.055) ** 2.4, 1, 0]],
                    "Oi": [[16, 2 * math.pi, 1 / math.pi]]})

    def test_spherical_harmonics(self):
        # Light of one direction's harmonics, turned by a quarter about z: x goes to y.
        turned = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        source = "#include <stdrsl/SphericalHarmonics.h>\nsurface x(output varying color a = 0;" \
                 "output varying color b = 0; output varying float c = 0;) {" \
                 " stdrsl_SphericalHarmonic h, other; color k[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};" \
                 " h->createFromArray(k); a = h->evaluate(vector \"current\" (0.6, 0, 0.8));" \
                 " float f[4] = {1, 0, 0, 1}; other->createFromArray(f);" \
                 " c = comp(h->convolve(other, 0), 0); h->rotate(\"turned\");" \
                 " b = h->evaluate(vector \"current\" (0, 0.6, 0.8)); }"
        y = [0.28209479, 0, 0.48860251 * 0.8, 0.48860251 * 0.6, 0, 0, 0.31539157 * (3 * 0.64 - 1),
             1.0925484 * 0.48, 0.54627421 * 0.36]
        light = sum((k + 1) * value for k, value in enumerate(y))
        self.check(source, {"spaces": {"turned": turned}},
                   {"a": [[light] * 3], "b": [[light] * 3], "c": [5]})

    def test_radiance_samples(self):
        self.check("#include <stdrsl/RadianceSample.h>\nsurface x() { __radiancesample a[];"
                   " resize(a, 3); float i; for (i = 0; i < 3; i += 1)"
                   " a[i]->setMaterialResponse(i + 1, 1); stdrsl_RadianceSample r;"
                   " float counts[2] = {1, 2}; r->normalizeMaterialResponse(a, counts);"
                   " r->accumulateMaterialResponse(a); Ci = a[0]->materialResponse;"
                   " Oi = a[2]->accumulatedMaterialResponse; }", {},
                   {"Ci": [[3] * 3], "Oi": [[4.5] * 3]})


if __name__ == "__main__":
    main()
