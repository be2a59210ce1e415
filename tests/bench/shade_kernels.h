// tests/bench/shade_kernels.h: shaders of assets as kernels of the fast tier, and points to run
// them on.
#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "jit/compiler.h"
#include "jit/ir/kernel_call.h"
#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "rsl/model/kernel_keys.h"
#include "runtime/base/arena.h"
#include "runtime/base/check.h"
#include "tests/folders.h"

namespace kinora {

inline constexpr size_t kLanes = jit::kMaxLanes;
inline const float kAxis[3] = {0.35f, -0.5f, 0.79f};  // of the distant light, in current space
inline const float kAmbient = 0.15f;

inline double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + double(now.tv_nsec) * 1e-9;
}

inline std::string shader_text(const std::string& name) {
    std::stringstream text;
    for (const char* folder : {"/assets/shaders/", "/tests/bench/"}) {
        std::ifstream file(project_folder() + folder + name + ".sl");
        if (file) text << file.rdbuf();
    }
    CHECK(!text.str().empty());
    return text.str();
}

// ---- points -------------------------------------------------------------------------------------

// A bumpy sheet seen from the origin of current space, in the columns that a grid has.
struct Points {
    Arena arena;
    size_t count;
    float *P[3], *N[3], *Ng[3], *I[3], *object[3][4];

    explicit Points(size_t n) : count(n) {
        for (auto* triple : {P, N, Ng, I})
            for (int k = 0; k < 3; ++k) triple[k] = arena.allocate_span<float>(n).data();
        const float rows[3][4] = {{0.8f, 0, 0.6f, 0.5f}, {0, 1, 0, -0.25f}, {-0.6f, 0, 0.8f, 0.1f}};
        for (size_t r = 0; r < 3; ++r)
            for (size_t c = 0; c < 4; ++c) {
                object[r][c] = arena.allocate_span<float>(n).data();
                std::fill_n(object[r][c], n, rows[r][c]);
            }
        for (size_t i = 0; i < n; ++i) place(i);
    }
    void place(size_t i) {
        size_t width = size_t(std::sqrt(double(count)));
        float x = float(i % width) / float(width) * 4 - 2;
        float y = float(i / width) / float(width) * 4 - 2;
        float at[3] = {x, y, 5 + 0.3f * std::sin(3 * x) * std::cos(2 * y)};
        float normal[3] = {0.9f * std::cos(3 * x), -0.6f * std::sin(2 * y), -1};
        for (int k = 0; k < 3; ++k) {
            P[k][i] = I[k][i] = at[k];
            N[k][i] = normal[k];
            Ng[k][i] = k == 2 ? -1.0f : 0.0f;
        }
    }
    const float* column(const rsl::KernelKey& key) const {
        if (key.kind == rsl::KeyKind::Global) {
            if (key.global() == rsl::Global::P) return P[key.component];
            if (key.global() == rsl::Global::N) return N[key.component];
            if (key.global() == rsl::Global::Ng) return Ng[key.component];
            if (key.global() == rsl::Global::I) return I[key.component];
        }
        CHECK(key.kind == rsl::KeyKind::SpaceFromCurrent && rsl::name_of(key) == "object");
        return object[key.row()][key.column()];
    }
};

// ---- the JIT's side -----------------------------------------------------------------------------

struct Compiled {
    Diagnostics diagnostics;
    std::unique_ptr<rsl::Shader> shader;
    rsl::Layer layer;
    rsl::LoweredShader lowered;
    jit::KernelPair kernels;
    std::vector<float> frame;
};

inline std::unique_ptr<rsl::Shader> front_end(const std::string& text, Diagnostics& diagnostics) {
    rsl::ShaderSource source{text, {}};
    source.map.file = diagnostics.files.add("bench.sl", text);
    source.map.segments = {{0, 0}};
    auto shaders = rsl::compile(source, {}, diagnostics);
    CHECK_EQ(shaders.size(), size_t(1));
    return std::move(shaders[0]);
}

inline rsl::LoweredShader lower_fast(const rsl::Layer& layer, Diagnostics& diagnostics) {
    rsl::LowerOptions options;
    options.math = jit::math::Tier::Fast;
    auto lowered = rsl::lower(std::span(&layer, 1), options, diagnostics);
    CHECK(lowered.has_value());
    return std::move(*lowered);
}

// What runtime/scene/shaders/shader_instance.cpp gives a parameter that the scene sets: 0 and 1
// belong to the shape.
inline std::vector<rsl::ParamBinding> bound_parameters(const rsl::Shader& shader) {
    std::vector<rsl::ParamBinding> bindings;
    for (const rsl::ShaderParameter& p : shader.parameters) {
        rsl::ParamBinding binding{std::string(p.name), rsl::ParamBinding::Kind::Frame, {}, {}};
        float first = p.constant->numbers[0];
        if (p.type == rsl::Type{rsl::BaseType::Float, -1} && (first == 0 || first == 1)) {
            binding.kind = rsl::ParamBinding::Kind::Constant;
            binding.constant = {first};
        }
        bindings.push_back(binding);
    }
    return bindings;
}

// Parameters, and the light's own space, whose z axis is the light's backwards.
inline float frame_value(const rsl::Shader& shader, const rsl::KernelKey& key) {
    if (key.kind == rsl::KeyKind::SpaceToCurrent && rsl::name_of(key) == "shader")
        return key.column() == 2 ? -kAxis[key.row()] : 0.0f;
    for (const rsl::ShaderParameter& p : shader.parameters)
        if (key.kind == rsl::KeyKind::Parameter && p.name == rsl::name_of(key))
            return p.constant->numbers[key.component];
    CHECK_EQ(rsl::text(key), "a known frame input");
    return 0;
}

inline std::vector<float> frame_block(const Compiled& compiled) {
    if (!compiled.kernels.frame) return {};
    const jit::Kernel& kernel = *compiled.kernels.frame;
    Arena arena;
    auto row = [&](float value) {
        std::span<float> lanes = arena.allocate_span<float>(kLanes);
        std::fill(lanes.begin(), lanes.end(), value);
        return lanes.data();
    };
    std::vector<const float*> in;
    for (const jit::InputInfo& info : kernel.inputs)
        in.push_back(row(frame_value(*compiled.shader, rsl::key_of(info))));
    std::vector<float*> out;
    for (size_t k = 0; k < kernel.outputs.size(); ++k) out.push_back(row(0));
    std::vector<uint8_t> faults(kernel.fault_sites.size());
    jit::KernelCall{.kernel = kernel,
                    .count = 1,
                    .in = in,
                    .out = out,
                    .row_floats = kLanes,
                    .scratch = arena.allocate_span<std::byte>(kernel.scratch_bytes),
                    .faults = faults}
        .run();
    std::vector<float> frame;
    for (float* lanes : out) frame.push_back(lanes[0]);
    return frame;
}

// From its shader to kernels.
inline void finish(Compiled& compiled, const jit::Target& target, bool bound) {
    compiled.layer.shader = compiled.shader.get();
    if (bound) compiled.layer.params = bound_parameters(*compiled.shader);
    compiled.lowered = lower_fast(compiled.layer, compiled.diagnostics);
    compiled.kernels = jit::compile(compiled.lowered.module, {&target, nullptr});
    CHECK(compiled.kernels.point->target == std::string(target.name));
    compiled.frame = frame_block(compiled);
}

inline std::unique_ptr<Compiled> compile(const std::string& name, const jit::Target& target,
                                         bool bound) {
    auto result = std::make_unique<Compiled>();
    result->shader = front_end(shader_text(name), result->diagnostics);
    finish(*result, target, bound);
    return result;
}

// A kernel over all grids: the arguments of each are made ready, as a renderer's are when it has
// gathered a grid.
class Run {
  public:
    Run(const Compiled& compiled, const Points& points, size_t grid)
        : kernel_(*compiled.kernels.point) {
        size_t grids = points.count / grid;
        for (const jit::OutputInfo& info : kernel_.outputs) {
            out[info.name] = arena_.allocate_span<float>(points.count).data();
        }
        faults_.resize(kernel_.fault_sites.size());
        auto scratch = arena_.allocate_span<std::byte>(kernel_.scratch_bytes);
        for (size_t g = 0; g < grids; ++g) {
            auto in = arena_.allocate_span<const float*>(kernel_.inputs.size());
            for (size_t k = 0; k < kernel_.inputs.size(); ++k)
                in[k] = points.column(rsl::key_of(kernel_.inputs[k])) + g * grid;
            auto outs = arena_.allocate_span<float*>(kernel_.outputs.size());
            for (size_t k = 0; k < kernel_.outputs.size(); ++k)
                outs[k] = out[kernel_.outputs[k].name] + g * grid;
            parts_.push_back({.kernel = kernel_,
                              .count = grid,
                              .in = in,
                              .out = outs,
                              .row_floats = points.count - g * grid,
                              .frame = compiled.frame,
                              .scratch = scratch,
                              .faults = faults_});
            calls_.emplace_back(parts_.back());
        }
    }
    void set_records(size_t g, const jit::RecordSet* set) {
        parts_[g].record_sets = {set, 1};
        calls_[g] = jit::CheckedCall(parts_[g]);
    }
    void run(size_t g) const { calls_[g].run(); }
    size_t grids() const { return calls_.size(); }

    std::map<std::string, float*> out;

  private:
    const jit::Kernel& kernel_;
    Arena arena_;
    std::vector<uint8_t> faults_;
    std::vector<jit::KernelCall> parts_;  // of a grid each
    std::vector<jit::CheckedCall> calls_;
};

}  // namespace kinora
