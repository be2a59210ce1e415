// tests/rsl/specialise_test.cpp: kernels are specialised on shape alone
// (docs/decisions.md#specialise-on-shape-only): a parameter that is 0 takes its term out of the
// code, all other values share one kernel.
#include <gtest/gtest.h>

#include "jit/compiler.h"
#include "jit/passes/passes.h"
#include "rsl/compile.h"
#include "rsl/lower/lower.h"

namespace kinora::rsl {
namespace {

const char* const kPlastic = R"(
surface plastic(float Ka = 1, Kd = 0.5, Ks = 0.5, roughness = 0.1; color specularcolor = 1;
                color base = 1;) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    Oi = Os;
    Ci = Os * (base * (Ka * ambient() + Kd * diffuse(Nf)) +
               specularcolor * Ks * specular(Nf, V, roughness));
})";
const char* const kMatte = R"(
surface plastic(float Ka = 1, Kd = 0.5; color base = 1;) {
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * (base * (Ka * ambient() + Kd * diffuse(Nf)));
})";

struct Compiled {
    jit::Module module;  // after the passes
    jit::KernelPair kernels;
};

// Every parameter read from the frame block, but `zero`, which is known to be 0.
Compiled compile_with(const std::string& text, const std::string& zero) {
    Diagnostics diagnostics;
    ShaderSource source{text, {}};
    source.map.file = diagnostics.files.add("test.sl", text);
    source.map.segments = {{0, 0}};
    auto shaders = compile(source, {}, diagnostics);
    EXPECT_EQ(shaders.size(), 1u);
    Layer layer{shaders[0].get(), {}};
    for (const ShaderParameter& p : shaders[0]->parameters) {
        ParamBinding binding{std::string(p.name), ParamBinding::Kind::Frame, {}, {}};
        if (binding.name == zero) {
            binding.kind = ParamBinding::Kind::Constant;
            binding.constant = {0};
        }
        layer.params.push_back(binding);
    }
    auto lowered = lower(std::span(&layer, 1), {}, diagnostics);
    EXPECT_TRUE(lowered.has_value());
    Compiled compiled{lowered->module, jit::compile(lowered->module)};
    jit::Module frame;
    jit::optimize(compiled.module, &frame);
    return compiled;
}

TEST(Specialise, AZeroKsCostsNothing) {
    size_t with = compile_with(kPlastic, "").module.kernel().insts.size();
    size_t without = compile_with(kPlastic, "Ks").module.kernel().insts.size();
    size_t matte = compile_with(kMatte, "").module.kernel().insts.size();
    EXPECT_EQ(without, matte);
    EXPECT_GT(with, matte + 20);
}

TEST(Specialise, AThousandColoursOfPlasticShareOneKernel) {
    auto plastic_of = [](int k) {
        std::string text = kPlastic;
        std::string color = "color(0." + std::to_string(1000 + k) + ", 0.3, 0.7)";
        text.replace(text.find("base = 1"), 8, "base = " + color);
        return compile_with(text, "").kernels;
    };
    auto first = plastic_of(0);
    size_t kernels = jit::cache_stats().kernels;
    for (int k = 1; k < 1000; ++k) EXPECT_EQ(plastic_of(k).point, first.point);
    EXPECT_EQ(jit::cache_stats().kernels, kernels);
    EXPECT_LE(first.point->code_bytes + first.point->scratch_bytes, 64u * 1024);
}

}  // namespace
}  // namespace kinora::rsl
