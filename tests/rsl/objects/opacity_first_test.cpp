// tests/rsl/objects/opacity_first_test.cpp: surfaces that skip what only a color needs where
// nothing shows: all bits elsewhere stay, and what is asked of the renderer there is counted.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "jit/target.h"
#include "tests/folders.h"
#include "tests/rsl/differential.h"
#include "tests/rsl/edge_world.h"

namespace kinora::rsl {
namespace {

constexpr int kRow = 40;  // points, of which every fourth shows

int asked = 0;  // points that a texture was asked for

void count_texture(const jit::ServiceCall& call) {
    for (int k = 0; k < jit::kMaxLanes; ++k) {
        asked += (call.mask >> k) & 1;
        for (int c = 0; c < 4; ++c) call.results[c * jit::kMaxLanes + k] = 0.25f;
    }
}

LowerOptions skipping(bool skip) {
    LowerOptions options;
    options.skip_transparent = skip;
    return options;
}

struct Shaded {
    std::map<std::string, std::vector<float>> out;
    int asked = 0;
};

Shaded shade(const std::string& body, bool skip, const char* target, LowerOptions options = {}) {
    options.skip_transparent = skip;
    RunShader run("surface t(string map = \"m\"; output varying float left = 0;) { " + body + " }",
                  options, {}, false, target);
    EXPECT_TRUE(run.ok()) << run.findings();
    if (!run.ok()) return {};
    for (int i = 0; i < kRow; ++i) {
        run.inputs["s"].push_back(float(i));
        run.inputs["t"].push_back(float(i % 7) - 3);
    }
    run.services[Service::texture] = count_texture;
    asked = 0;
    Shaded result{run.run(kRow), 0};
    result.asked = asked;
    return result;
}

// The module's text tells whether anything was moved.
std::string lowered(const std::string& body, bool skip, LowerOptions options = {}) {
    options.skip_transparent = skip;
    RunShader run("surface t(string map = \"m\"; output varying float left = 0;) { " + body + " }",
                  options);
    EXPECT_TRUE(run.ok()) << run.findings();
    return jit::print(run.lowered.module);
}

const char* kCut = "Oi = mod(s, 4) == 0 ? 0.5 : 0; ";

TEST(OpacityFirst, AsksATextureForWhatShowsAlone) {
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        std::string body = std::string("color c = texture(map, s, t); ") + kCut + "Ci = c * Oi;";
        Shaded all = shade(body, false, target.name), seen = shade(body, true, target.name);
        EXPECT_EQ(all.asked, kRow) << target.name;
        EXPECT_EQ(seen.asked, kRow / 4) << target.name;
        for (int i = 0; i < kRow; ++i) {
            EXPECT_EQ(seen.out["Ci.r"][size_t(i)], i % 4 == 0 ? 0.125f : 0) << i;
            EXPECT_EQ(seen.out["Oi.g"][size_t(i)], i % 4 == 0 ? 0.5f : 0) << i;
        }
    }
}

struct Form {
    const char* what;
    const char* body;
    bool skips;
};
const std::string kLoop =
    "float k, x = 0; for (k = 0; k < 20; k += 1) x += float noise(s + k * t);";
const Form kForms[] = {
    {"a product", "Ci = Oi * x;", true},
    {"the other way round", "Ci = x * color(1, 2, 3) * Oi;", true},
    {"a sum of products", "Ci = Oi * x + x * 3 * Oi - Oi;", true},
    {"assigned last", "Ci = x; Ci *= Oi;", true},
    {"two cases", "if (s > 5) Ci = x * Oi; else Ci = -Oi;", true},
    {"glowing", "Ci = x;", false},
    {"partly glowing", "Ci = Oi * x + 0.1;", false},
    {"of another factor", "Ci = Os * x;", false},
    {"the color decides the opacity", "Oi *= x; Ci = Oi * x;", false},
    {"also an output", "Ci = Oi * x; left = x;", true},  // nobody asked for it
    {"opacity as the object's", "Oi = Os; Ci = Oi * x;", false},
    {"opacity of the frame", "Oi = 0.5; Ci = Oi * x;", false},
    {"too little", "Ci = Oi * 2;", false},
};

TEST(OpacityFirst, SkipsColorsThatOpacityMultiplies) {
    for (const Form& form : kForms) {
        std::string body =
            std::string(kCut) + (std::string(form.what) == "too little" ? "" : kLoop) + form.body;
        EXPECT_EQ(lowered(body, true) != lowered(body, false), form.skips) << form.what;
        Shaded all = shade(body, false, "interp"), seen = shade(body, true, "interp");
        for (auto& [name, values] : all.out)
            for (size_t i = 0; i < kRow; ++i) EXPECT_EQ(seen.out[name][i], values[i]) << form.what;
    }
}

TEST(OpacityFirst, LeavesWhatSomethingElseNeeds) {
    LowerOptions with_output;
    with_output.aovs = {"left"};
    std::string body =
        std::string("color c = texture(map, s, t); left = comp(c, 0); ") + kCut + "Ci = c * Oi;";
    Shaded seen = shade(body, true, "interp", with_output);
    EXPECT_EQ(seen.asked, kRow);
    for (size_t i = 0; i < kRow; ++i) EXPECT_EQ(seen.out.at("aov:left")[i], 0.25f) << i;
}

// Elements are written before and behind what opacity reads of the array.
TEST(OpacityFirst, KeepsTheOrderInWhichArraysAreWritten) {
    std::string body =
        "float a[4]; float i; for (i = 0; i < 4; i += 1) a[i] = i * t;"
        "Oi = a[mod(s, 4)] > 1 ? 1 : 0; a[mod(s, 4)] = 100; a[1] += s;"
        "color c = texture(map, a[1], a[mod(s, 4)]); Ci = Oi * c * (a[0] + a[1] + a[2] + a[3]);";
    ASSERT_NE(lowered(body, true), lowered(body, false));
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        Shaded all = shade(body, false, target.name), seen = shade(body, true, target.name);
        EXPECT_LT(seen.asked, all.asked);
        for (size_t i = 0; i < kRow; ++i) EXPECT_EQ(seen.out["Ci.b"][i], all.out["Ci.b"][i]) << i;
    }
}

TEST(OpacityFirst, GivesZeroWhereTheColorIsInfiniteAndNothingShows) {
    Shaded seen =
        shade(kLoop + kCut + "Ci = Oi * pow(10, 30 + x) * pow(10, 30 + x);", true, "interp");
    for (size_t i = 0; i < kRow; ++i) {
        if (i % 4 == 0) continue;
        EXPECT_EQ(std::bit_cast<int32_t>(seen.out["Ci.r"][i]), 0) << i;
    }
}

// Every surface of the assets at edges of all inputs: where something shows, no bit differs.
TEST(OpacityFirst, ChangesNoBitOfTheAssetsWhereSomethingShows) {
    int surfaces = 0, moved = 0;
    for (auto& entry :
         std::filesystem::recursive_directory_iterator(project_folder() + "/assets/shaders")) {
        if (entry.path().extension() != ".sl") continue;
        std::ifstream file(entry.path());
        std::ostringstream text;
        text << file.rdbuf();
        RunShader plain(text.str(), skipping(false)), first(text.str(), skipping(true));
        if (!plain.ok() || plain.shaders.back()->kind != ShaderKind::Surface) continue;
        ASSERT_TRUE(first.ok()) << entry.path() << first.findings();
        ++surfaces;
        moved += jit::print(plain.lowered.module) != jit::print(first.lowered.module);
        std::map<std::string, std::vector<float>> outs[2];
        for (RunShader* run : {&plain, &first}) {
            run->inputs = edge_points(uint64_t(surfaces), kRow);
            add_edge_world(*run, uint64_t(surfaces), kRow);
            outs[run == &first] = run->run(kRow);
        }
        for (size_t i = 0; i < kRow; ++i) {
            bool shows =
                outs[0]["Oi.r"][i] != 0 || outs[0]["Oi.g"][i] != 0 || outs[0]["Oi.b"][i] != 0;
            for (auto& [name, values] : outs[0]) {
                auto was = std::bit_cast<int32_t>(values[i]);
                auto is = std::bit_cast<int32_t>(outs[1][name][i]);
                bool nans = std::isnan(values[i]) && std::isnan(outs[1][name][i]);
                bool dark = !shows && name.starts_with("Ci.") && is == 0;
                EXPECT_TRUE(was == is || nans || dark) << entry.path() << " " << name << " " << i;
            }
        }
    }
    EXPECT_GE(surfaces, 60);
    EXPECT_GE(moved, 1);
}

}  // namespace
}  // namespace kinora::rsl
