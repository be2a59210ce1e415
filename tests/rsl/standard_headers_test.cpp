// tests/rsl/standard_headers_test.cpp: the headers of assets/shaders/include: found by default, and
// every function of theirs compiles where shaders call it.
#include "rsl/text/standard_headers.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "tests/folders.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

// Calls of all names of the customary headers, as shaders write them (docs/language.md#text).
struct HeaderRow {
    const char* header;
    const char* parameters;
    const char* body;
};
const HeaderRow kHeaders[] = {
    {"filterwidth.h", "", "Ci = filterwidth(s) + filterwidthp(P) + MINFILTWIDTH;"},
    {"noises.h", "",
     "point p1, p2; float f1, f2, s1, t1, s2, t2;"
     "Ci = snoise(P) + snoisexy(s, t) + color vsnoise(P) + filteredsnoise(P, 0.1);"
     "Ci += color filteredvsnoise(P, 0.1) + udn(s, 1, 2) + udn2(s, t, 1, 2);"
     "Ci += fBm(P, 0.1, 4, 2, 0.5) + fBm_default(P) + color vfBm(P, 0.1, 4, 2, 0.5);"
     "Ci += color vfBm_default(P) + VLNoise(P, 1) + VLfBm(P, 0.1, 4, 2, 0.5, 1) + VLfBm_default(P);"
     "Ci += turbulence(P, 0.1, 4, 2, 0.5) + turbulence_default(P);"
     "voronoi_f1_3d(P, 1, f1, p1); voronoi_f1f2_3d(P, 1, f1, p1, f2, p2);"
     "voronoi_f1_2d(s, t, 1, f1, s1, t1); voronoi_f1f2_2d(s, t, 1, f1, s1, t1, f2, s2, t2);"
     "Ci += f1 + f2 + s1 + t2 + color(p1 - p2);"},
    {"patterns.h", "",
     "float row, column, x, y, ss, tt;"
     "basicbrick(s, t, 0.2, 0.1, 0.5, 0.1, 5, 0.1, column, row, x, y);"
     "Ci = sqr(s) + pulse(0.2, 0.8, s) + pulsetrain(0.3, 1, s * 4) + filteredabs(s - 0.5, 0.1);"
     "Ci += filteredsmoothstep(0, 1, s, 0.1) + filteredpulse(0.2, 0.8, s, 0.1);"
     "Ci += filteredpulsetrain(0.3, 1, s * 4, 0.1) + smoothpulse(0.1, 0.2, 0.8, 0.9, s);"
     "Ci += smoothpulsetrain(0.1, 0.2, 0.8, 0.9, 1, s * 4) + column + row + x + y;"
     "Ci += tilepattern(s * 4, t * 4, 0.1, 0.1, 0.05, ss, tt) + ss + tt;"},
    {"reflections.h", "DECLARE_DEFAULTED_ENVPARAMS; string reflname = \"\";",
     "float a, b; vector R = reflect(normalize(I), normalize(N));"
     "Ci = Environment(envname, envspace, envrad, P, R, 0, a) + ReflMap(reflname, P, 0.1, b) + a + "
     "b;"
     "Ci += SampleEnvironment(P, R, 1, 0, ENVPARAMS);"},
    {"raytrace.h", "",
     "float a; vector R = reflect(normalize(I), normalize(N));"
     "Ci = RayTrace(P, R, 1, 0.1, 1, 4, a) + RayTrace(P, R, 1, 0, 1, a) + a;"},
    {"material.h", "DECLARE_DEFAULTED_ENVPARAMS; color c = 0.5;",
     "normal Nf = faceforward(normalize(N), I); vector V = -normalize(I);"
     "Ci = MaterialMatte(Nf, c, 1, 1) + MaterialPlastic(Nf, c, 1, 1, 1, 0.1);"
     "Ci += MaterialThinPlastic(Nf, V, c, 1, 1, 1, 1, 0.1) + MaterialRoughMetal(Nf, c, 1, 1, 1, "
     "0.1);"
     "Ci += MaterialShinyMetal(Nf, c, 1, 1, 1, 0.1, 1, 0, 1, ENVPARAMS);"
     "Ci += MaterialShinyPlastic(Nf, c, 1, 1, 1, 0.1, 1, 0, 1.5, 1, ENVPARAMS);"
     "Ci += MaterialClay(Nf, c, 1, 1, 0.5) + MaterialBrushedMetal(Nf, c, 1, 1, 1, 0.1, 0.3);"
     "Ci += MaterialCeramic(Nf, c, 1, 1, 1, 0.1, 0.5, 1, 0, 1.5, 1, ENVPARAMS);"
     "Ci += MaterialGlass(normalize(N), c, 0, 0, 1, 0.1, 1, 0, 1, 0, 1.5, ENVPARAMS);"},
    {"material.h", "DECLARE_DEFAULTED_ENVPARAMS; color c = 0.5;",
     "normal Nf = faceforward(normalize(N), I);"
     "Ci = MaterialShinyMetal(Nf, c, 1, 1, 1, 0.1, 1, 0, ENVPARAMS);"
     "Ci += MaterialShinyPlastic(Nf, c, 1, 1, 1, 0.1, 1, 0, 1.5, ENVPARAMS);"
     "Ci += MaterialBrushedMetal(Nf, c, 1, 1, 1, dPdv, 0.1, 0.3);"
     "Ci += MaterialCeramic(Nf, c, 1, 1, 1, 0.1, 0.5, 1, 0, 1.5, ENVPARAMS);"
     "Ci += MaterialGlass(normalize(N), c, 0, 0, 1, 0.1, 1, 0, 1, 0, 1.5, color(1, 0, 0), "
     "ENVPARAMS);"},
    {"rmannotes.h", "",
     "float a, b; rotate2d(s, t, 0.1, 0.5, 0.5, a, b); topolar2(s, t, a, b);"
     "Ci = blend(color(1, 0, 0), color(0, 1, 0), pulse(0.2, 0.3, 0.1, repeat(s, 3))) + a + b;"
     "Ci = union(Ci, color(0.1, 0.1, 0.1)) * gamma(2, s) * boxpulse(0.2, 0.3, 0.1, t);"
     "Ci += snoise(P) + snoise2(s, t) + filterwidth_point(P) + odd(whichtile(s, 3)) + bias(s, t);"
     "Ci += udn(s, 0, 1) + udn2(s, t, 0, 1);"},
    {"locillum.h", "",
     "normal Nf = faceforward(normalize(N), I); vector V = -normalize(I);"
     "Ci = LocIllumOrenNayar(Nf, V, 0.5) + LocIllumGlossy(Nf, V, 0.1, 0.5);"
     "Ci += LocIllumWardAnisotropic(Nf, V, dPdu, 0.1, 0.3);"},
    {"normals.h", "", "Ci = color(shadingnormal(N));"},
    {"broadlights.h", "", "Ci = broad_glow(P, N, reflect(I, N));"},
    {"collada_slots.h", "SLOT(ambient_color, 0); SLOT(diffuse, 0); float x = 0;",
     "Oi = slot_opacity(diffuse, diffuse_map, diffuse_s, diffuse_t, x, x, \"A_ONE\");"
     "Ci = mirrored(AMBIENT_COLOR, x, N, I, Oi, Cs) * color(bumped(ambient_color_map, \"\", s, t, "
     "x));"},
    {"project.h", "string how = \"spherical\";",
     "float ss, tt, ds, dt; ProjectTo2D(how, P, \"shader\", matrix 1, ss, tt, ds, dt);"
     "spherical_projection(transform(\"shader\", P), ss, tt); Ci = ss + tt + ds + dt;"
     "cylindrical_projection(transform(\"shader\", P), ss, tt); Ci += ss + tt;"},
    {"displace.h", "", "N = Displace(normalize(N), \"shader\", 0.1, 1); Ci = color N;"},
    {"stdrsl/math.h", "", "Ci = M_TWOPI * s + M_INVFOURPI + M_MAXDIST + M_PI + M_EPSILON;"},
    {"stdrsl/colors.h", "", "Ci = srgbToLinear(Cs) + linearToSrgb(Cs) + srgbToLinear(s);"},
    {"stdrsl/samplemgr.h", "",
     "stdrsl_SampleMgr m; float a, b, c; m->computeDepthBasedSampleReduction(1, 64, 4, 1, a);"
     "m->computeIndirectDiffuseSamples(64, 0.02, b, c); stdrsl_SampleMgrPathTrace path; float n;"
     "path->construct(); path->begin(); path->computeLightSamples(1, 16, n); Ci = a + b + c + n;"},
    {"stdrsl/shadingcontext.h", "",
     "stdrsl_ShadingContext c; c->construct(); c->init(); c->initWithTangentField(0.25);"
     "Ci = color(c->m_Nn + c->m_Ns + c->m_Tangent) + c->m_EnteringRegion + c->m_RayDepth;"
     "c->displace(c->m_Nn, 0.1 * s, \"bump\"); c->displace(c->m_Nn, 0.1, \"displace\");"
     "c->reinit(); c->initHair(0); Ci += color(c->m_Vn + c->m_In + c->m_Bitangent);"
     "normal Nn, Nf, Ns; vector In; c->m_ShadingUtils->GetShadingVars(0, 2, Nn, In, Nf, Ns);"
     "Ci += color(Nn + Nf + Ns) + c->m_DiffuseDepth + color(c->m_OrigNn) + color(In);"},
    {"stdrsl/fresnel.h", "",
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5);"
     "Ci = f->m_Kr + f->m_Kt + color(f->m_Rv + f->m_Tv); f->initSchlick(c, 1, 0, 0.04);"
     "Ci += f->m_Kr + color(f->m_Tv); f->initSchlick(c, 1, 1.3, 0.04); Ci += color(f->m_Tv);"},
    {"stdrsl/radiancesample.h", "",
     "__radiancesample a[]; resize(a, 2); a[0]->setLightSample(Cs, 0.5, vector N, 3);"
     "a[1]->setMaterialResponse(Cs, 0.25); stdrsl_RadianceSample r; float counts[2] = {1, 1};"
     "r->normalizeMaterialResponse(a, counts); r->accumulateMaterialResponse(a);"
     "Ci = a[0]->radiance + a[1]->accumulatedMaterialResponse + a[0]->lightPdf + a[1]->valid;"},
    {"stdrsl/lambert.h", "",
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5); stdrsl_Lambert d;"
     "d->init(Cs); d->init(c, Cs, 1, 4); __radiancesample a[]; d->genDiffuseSamps(c, f, a);"
     "d->evalDiffuseSamps(c, f, a); Ci = a[0]->materialResponse + arraylength(a);"},
    {"stdrsl/orennayar.h", "",
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5);"
     "stdrsl_OrenNayar d; d->init(Cs, 0.3); __radiancesample a[]; resize(a, 1);"
     "a[0]->direction = c->m_Vn; d->evalDiffuseSamps(c, f, a); Ci = a[0]->materialResponse;"},
    {"stdrsl/specularas.h", "",
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5); float below = 0;"
     "stdrsl_SpecularAS d; d->init(c, Cs, 0.2, 0.5, 1, 1, 4); __radiancesample a[];"
     "d->initWithDownstreamRoughness(0.3, c, Cs, 0.2, 0.5, 1, 4, below);"
     "d->genSpecularSamps(c, f, \"specular\", a); resize(a, 1); a[0]->direction = c->m_Vn;"
     "d->evalSpecularSamps(c, f, a); Ci = a[0]->materialResponse + a[0]->materialPdf + "
     "d->m_roughValueU;"
     "Ci += below;"},
    {"stdrsl/specularblinn.h", "",
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5);"
     "stdrsl_SpecularBlinn d; d->init(c, Cs, 0.2, 1, 4); __radiancesample a[];"
     "d->genSpecularSamps(c, f, \"specular\", a); resize(a, 1); a[0]->direction = c->m_Vn;"
     "d->evalSpecularSamps(c, f, a); Ci = a[0]->materialResponse + a[0]->materialPdf;"},
    {"stdrsl/speculardbrdf.h", "",
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5);"
     "stdrsl_SpecularDBRDF d; d->init(c, \"beckmann\", Cs, 0.2, 1, 4); __radiancesample a[];"
     "d->genSpecularSamps(c, f, \"specular\", a); resize(a, 1); a[0]->direction = c->m_Vn;"
     "d->evalSpecularSamps(c, f, a); Ci = a[0]->materialResponse + a[0]->materialPdf;"},
    {"stdrsl/bsdfcomponent.h", "",
     "struct Lobe : stdrsl_BSDFComponent { void evalSpecularSamps(stdrsl_ShadingContext c;"
     " stdrsl_Fresnel f; output __radiancesample a[]) { a[0]->setMaterialResponse(Cs, 1); } }"
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5); Lobe d;"
     "__radiancesample a[]; resize(a, 1); d->genSpecularSamps(c, f, \"specular\", a);"
     "d->genDiffuseSamps(c, f, a); d->evalDiffuseSamps(c, f, a); d->evalSpecularSamps(c, f, a);"
     "Ci = a[0]->materialResponse + d->m_sampleCount;"},
    {"stdrsl/isotropicvolume.h", "",
     "stdrsl_ShadingContext c; c->init(); stdrsl_Fresnel f; f->init(c, 1, 1.5);"
     "stdrsl_IsotropicVolume d; d->init(Cs); __radiancesample a[]; resize(a, 1);"
     "d->evalDiffuseSamps(c, f, a); Ci = a[0]->materialResponse;"},
    {"stdrsl/areasampler.h", "",
     "stdrsl_AreaSampler a; __radiancesample x[]; a->generateSamples(P, \"disc\", 4, x);"
     "a->evaluateSamples(P, \"sphere\", x); point o; vector d; float ss, tt, size;"
     "a->generatePhoton(\"rect\", 2, o, d, ss, tt, size);"
     "Ci = x[0]->radiance + color(o) + color(d) + ss + tt + size;"},
    {"stdrsl/hair.h", "",
     "stdrsl_ShadingContext c; c->initHair(0); stdrsl_Hair h; h->initDiffuse(c, 1, 1, 0.5, Cs, 1);"
     "h->initSpecular(c, 4, 0, 0.1, 0.2, 1, 1.55); __radiancesample a[];"
     "h->genDiffuseSamps(c, a); h->genSpecularSamps(c, a); h->evalDiffuseSamps(c, a);"
     "h->evalSpecularSamps(c, a); Ci = a[0]->materialResponse;"},
    {"filterregion.h", "string map = \"\";",
     "filterregion r; r->calculate2d(s, t); r->scale(2); r->blur(0.1); r->calculate3d(P);"
     "r->calculate2d(s, t, 0.1, 0, 0, 0.1); r->calculate3d(P, dPdu, dPdv);"
     "Ci = color texture(map, r) + float texture(map, r) + r->radius;"
     "Ci += color environment(map, r) + float environment(map, r); __radiancesample a[];"
     "resize(a, 1); areashadow(map, r, a, \"bias\", 0.1); Ci += a[0]->radiance;"},
    {"prman.h", "",
     "vector a[4]; randomstrat(0, 4, a); Ci = erf(s) + erfc(t) + gridnever(s) + color(a[2]);"
     "vector v = wnoise(P, 1); point p = wnoise(P, 1); color c = wnoise(P, 1), d = wnoise(s, 1);"
     "float x = wnoise(P), y = wnoise(s, 1); Ci += c + d + color v + color p + x + y;"},
    {"prman_samples.h", "string map = \"\";",
     "__radiancesample a[]; generateSamplesAS(Cs, 2, 10, 20, N, dPdu, -I, a);"
     "evaluateSamplesAS(Cs, 10, 20, N, dPdu, -I, a); generateSamplesEnv(map, P, N, 2, a);"
     "evaluateSamplesEnv(map, P, N, a); Ci = a[0]->radiance + a[0]->lightPdf;"
     "generateSamplesEnv(map, P, N, 2, a, \"environmentspace\", \"object\", \"scale\", Cs);"},
    {"stdrsl/sphericalharmonics.h", "",
     "stdrsl_SphericalHarmonic a, b; color k[9]; float f[4]; a->createFromArray(k);"
     "b->createFromArray(f); a->rotate(\"world\"); Ci = a->convolve(b, 0) + a->evaluate(vector "
     "N);"},
    {"getlights.h", "", "Ci = 1;"},     // its functions take lights: objects/lights_test.cpp
    {"integrators.h", "", "Ci = 1;"},   // its functions are of classes: tests/rsl/classes
    {"lightsamples.h", "", "Ci = 1;"},  // of lights: tests/runtime/sampled_lights_test.cpp
    {"util.h", "",
     "float rx, ry, r, theta; rotate2d(s, t, 0.5, 0.5, 0.5, rx, ry); topolar(s, t, r, theta);"
     "Ci = blend(Cs, Os, s) + lerp(0, 1, s) + boxstep(0.2, 0.4, s) + union(s, t) + complement(s);"
     "Ci += intersection(s, t) + difference(s, t) + repeat(s, 4) + whichtile(s, 4) + odd(floor(s));"
     "Ci += even(floor(t)) + bias(0.3, s) + gain(0.3, s) + luminance(Cs) + rx + ry + r + theta;"},
};

std::string shader_of(const HeaderRow& row) {
    return fmt::format("#include \"{}\"\nsurface x({}) {{ {} }}", row.header, row.parameters,
                       row.body);
}

TEST(StandardHeaders, EveryFunctionCompilesWithoutAWarning) {
    for (const HeaderRow& row : kHeaders) {
        TestSource source(shader_of(row));
        auto shaders = compile(source.source, {}, source.diagnostics);
        ASSERT_EQ(shaders.size(), 1u) << row.header << "\n" << source.messages();
        Layer layer{shaders[0].get(), {}};
        EXPECT_TRUE(lower({&layer, 1}, {}, source.diagnostics)) << source.messages();
        EXPECT_EQ(source.messages(), "") << row.header;
    }
}

TEST(StandardHeaders, AllOfThemAreTested) {
    std::filesystem::path folder =
        std::filesystem::path(project_folder()) / "assets/shaders/include";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_directory()) continue;
        std::string name = entry.path().lexically_relative(folder).generic_string();
        bool tested = std::any_of(std::begin(kHeaders), std::end(kHeaders),
                                  [&](const HeaderRow& row) { return row.header == name; });
        EXPECT_TRUE(tested) << name;
        EXPECT_FALSE(standard_header(name).empty()) << name;
    }
}

TEST(StandardHeaders, MayBeIncludedTogetherTwiceAndFromFolders) {
    std::string text;
    for (const HeaderRow& row : kHeaders)
        text += fmt::format("#include \"{}\"\n#include <shaders/{}>\n", row.header, row.header);
    TestSource source(text + "surface x() { Ci = 1; }");
    EXPECT_EQ(compile(source.source, {}, source.diagnostics).size(), 1u) << source.messages();
}

TEST(StandardHeaders, AreFoundAsSlToo) {
    EXPECT_EQ(standard_header("rmannotes.sl"), standard_header("rmannotes.h"));
    EXPECT_EQ(standard_header("../shaders/noises.sl"), standard_header("noises.h"));
    EXPECT_TRUE(standard_header("mine.sl").empty());
}

TEST(StandardHeaders, FilesOnTheIncludePathWin) {
    auto folder = std::filesystem::path(::testing::TempDir()) / "kinora_headers";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "noises.h") << "#define MINE 1\n";
    TestSource source("#include \"noises.h\"\nsurface x() { Ci = MINE; }");
    CompileOptions options;
    options.include_directories = {folder.string()};
    EXPECT_EQ(compile(source.source, options, source.diagnostics).size(), 1u) << source.messages();
    std::filesystem::remove_all(folder);
}

TEST(StandardHeaders, ErrorsInsideHaveTheHeadersPlace) {
    TestSource source("#include \"patterns.h\"\nsurface x() { Ci = filteredabs(N, Cs); }");
    compile(source.source, {}, source.diagnostics);
    EXPECT_NE(source.messages().find("argument 1 of 'filteredabs'"), std::string::npos)
        << source.messages();
}

TEST(StandardHeaders, KnowWhatTheyDefine) {
    EXPECT_EQ(header_that_defines("snoise"), "noises.h");
    EXPECT_EQ(header_that_defines("filterwidth"), "filterwidth.h");
    EXPECT_EQ(header_that_defines("MaterialPlastic"), "material.h");
    EXPECT_EQ(header_that_defines("integral"), "");
    EXPECT_EQ(header_that_defines("noise"), "");
}

}  // namespace
}  // namespace kinora::rsl
