// tests/rsl/lower_assets_test.cpp: the shaders of assets/shaders lower, verify and run.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "jit/target.h"
#include "tests/folders.h"
#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

std::string read_asset(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}
std::string asset(const std::string& name) {
    return read_asset(project_folder() + "/assets/shaders/" + name + ".sl");
}

void texture_service(const jit::ServiceCall& call) {
    for (int k = 0; k < 4 * jit::kMaxLanes; ++k) call.results[k] = 0.5f;
}

// Of what is not looked up all results are 0: of gather the record set 0.
constexpr ServiceTable kServiceTable = {
    .lights = answer_zeros<Service::lights>,
    .samplinglights = answer_zeros<Service::samplinglights>,
    .samplewish = answer_zeros<Service::samplewish>,
    .lightsample = answer_zeros<Service::lightsample>,
    .stratified = answer_zeros<Service::stratified>,
    .texture = texture_service,
    .environment = texture_service,
    .maplight = answer_zeros<Service::maplight>,
    .mapdensity = answer_zeros<Service::mapdensity>,
    .mapdirection = answer_zeros<Service::mapdirection>,
    .shadow = answer_zeros<Service::shadow>,
    .textureinfo = answer_zeros<Service::textureinfo>,
    .trace = texture_service,
    .transmission = answer_zeros<Service::transmission>,
    .occlusion = answer_zeros<Service::occlusion>,
    .indirectdiffuse = answer_zeros<Service::indirectdiffuse>,
    .gather = answer_zeros<Service::gather>,
    .raylimit = answer_zeros<Service::raylimit>,
    .query = answer_zeros<Service::query>,
    .bake3d = answer_zeros<Service::bake3d>,
    .texture3d = answer_zeros<Service::texture3d>,
    .photons = answer_zeros<Service::photons>,
    .transform = answer_zeros<Service::transform>,
    .print = answer_zeros<Service::print>,
};

void set_up(RunShader& shader) {
    shader.set3("N", 0, 0, 1);
    shader.set3("Ng", 0, 0, 1);
    shader.set3("I", 0.1f, 0.2f, -2);
    shader.set3("P", 0.3f, 0.7f, -0.4f);
    shader.lights.resize(2);
    shader.set_services(kServiceTable);
}

TEST(Assets, AllShadersLowerAndRunFinite) {
    int count = 0;
    for (auto& entry : std::filesystem::directory_iterator(project_folder() + "/assets/shaders")) {
        if (entry.path().extension() != ".sl") continue;
        // Volumes and imagers change what is there already, which this run does not give them.
        std::string text = read_asset(entry.path());
        if (text.find("\nvolume ") != text.npos || text.find("\nimager ") != text.npos) continue;
        RunShader shader(text);
        ASSERT_TRUE(shader.ok()) << entry.path() << "\n" << shader.findings();
        set_up(shader);
        for (auto& [name, values] : shader.run(17))
            for (float value : values) EXPECT_TRUE(std::isfinite(value)) << entry.path() << name;
        ++count;
    }
    EXPECT_GE(count, 20);
}

TEST(Assets, EveryTargetGivesTheSameBits) {
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        for (const char* name : {"matte", "plastic", "marble", "wood", "spotlight", "pointlight"}) {
            RunShader expected(asset(name));
            RunShader shader(asset(name), {}, {}, false, target.name);
            ASSERT_TRUE(shader.ok()) << shader.findings();
            std::vector<float> x, z;
            for (int k = 0; k < 37; ++k) x.push_back(0.37f * float(k) - 3), z.push_back(-1 - x[0]);
            for (RunShader* each : {&expected, &shader}) {
                set_up(*each);
                each->set("P.x", x);
                each->set("Ps.x", x);
                each->set("Ps.z", -3);
                each->set("I.y", z);
            }
            auto want = expected.run(37), got = shader.run(37);
            for (auto& [output, values] : want)
                for (size_t k = 0; k < values.size(); ++k)
                    EXPECT_EQ(std::bit_cast<int>(values[k]), std::bit_cast<int>(got[output][k]))
                        << target.name << " " << name << " " << output << " " << k;
        }
    }
}

TEST(Assets, ColladaOpacityFollowsItsModes) {
    using Kind = ParamBinding::Kind;
    auto opacity = [](const char* mode) {
        RunShader shader(asset("collada_phong"), {},
                         {{"opaque", Kind::Constant, {}, {mode}},
                          {"transparent", Kind::Constant, {0.25f, 0.5f, 1}, {}},
                          {"transparent_alpha", Kind::Constant, {0.75f}, {}},
                          {"transparency", Kind::Constant, {0.5f}, {}}});
        EXPECT_TRUE(shader.ok()) << shader.findings();
        set_up(shader);
        return shader.value("Oi.g");
    };
    EXPECT_FLOAT_EQ(opacity("A_ONE"), 0.375f);
    EXPECT_FLOAT_EQ(opacity("A_ZERO"), 0.625f);
    EXPECT_FLOAT_EQ(opacity("RGB_ONE"), 0.25f);
    EXPECT_FLOAT_EQ(opacity("RGB_ZERO"), 0.75f);
    EXPECT_FLOAT_EQ(opacity("NONE"), 1);
}

// COLLADA 1.4.1, <blinn>: max(N . H, 0) ^ shininess.
TEST(Assets, ColladaBlinnIsToThePowerShininess) {
    using Kind = ParamBinding::Kind;
    for (float shininess : {1.0f, 20.0f, 128.0f}) {
        RunShader shader(asset("collada_blinn"), {},
                         {{"specular", Kind::Constant, {1, 0.5f, 0}, {}},
                          {"shininess", Kind::Constant, {shininess}, {}}});
        ASSERT_TRUE(shader.ok()) << shader.findings();
        set_up(shader);
        shader.set3("I", 0, 0, -2);
        TestLight light;
        light.L[0] = 3;
        light.L[2] = 4;
        shader.lights = {light};
        double want = std::pow(1.8 / std::sqrt(0.6 * 0.6 + 1.8 * 1.8), double(shininess));
        auto out = shader.run();
        double tolerance = (1e-6 + 2e-7 * double(shininess)) * want;  // N . H is a float
        EXPECT_NEAR(out["Ci.r"][0], want, tolerance) << shininess;
        EXPECT_NEAR(out["Ci.g"][0], want / 2, tolerance) << shininess;
        EXPECT_EQ(out["Ci.b"][0], 0);
    }
}

TEST(Assets, ColladaTexturesReplaceColors) {
    using Kind = ParamBinding::Kind;
    RunShader shader(asset("collada_constant"), {},
                     {{"emission_map", Kind::Constant, {}, {"a.png"}}});
    ASSERT_TRUE(shader.ok()) << shader.findings();
    set_up(shader);
    EXPECT_EQ(shader.value("Ci.r"), 0.5f);
    EXPECT_EQ(shader.lowered.opacity, LoweredShader::Opacity::Opaque);
}

TEST(Assets, ColladaSpotFallsOff) {
    using Kind = ParamBinding::Kind;
    RunShader light(asset("collada_spot"), {},
                    {{"falloff_angle", Kind::Constant, {60}, {}},
                     {"falloff_exponent", Kind::Constant, {2}, {}},
                     {"quadratic_attenuation", Kind::Constant, {1}, {}},
                     {"constant_attenuation", Kind::Constant, {0}, {}}});
    ASSERT_TRUE(light.ok()) << light.findings();
    // On the axis, 20 degrees off, 40 degrees off.
    float tan20 = std::tan(20 * 3.14159265f / 180);
    light.set("Ps.x", {0, 2 * tan20, 2});
    light.set("Ps.z", 2);  // a light looks along z
    auto Cl = light.run(3)["light:0:Cl.r"];
    EXPECT_FLOAT_EQ(Cl[0], 0.25f);
    float cos20 = std::cos(20 * 3.14159265f / 180);
    EXPECT_NEAR(Cl[1], cos20 * cos20 / (4 * (1 + tan20 * tan20)), 1e-6);
    EXPECT_EQ(Cl[2], 0);
}

}  // namespace
}  // namespace kinora::rsl
