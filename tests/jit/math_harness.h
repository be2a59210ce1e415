// tests/jit/math_harness.h: runs functions of jit/math over arrays, and measures ULP.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "jit/ir/builder.h"
#include "jit/ir/kernel_call.h"
#include "jit/math/math.h"
#include "jit/target.h"

namespace kinora::jit::testing {

using Writer = std::function<std::vector<Value>(Builder&, std::span<const Value>)>;

// A kernel with `inputs` float inputs and the float outputs that `write` makes of them.
class MathKernel {
  public:
    MathKernel(int inputs, const Writer& write, const char* target = "interp") {
        Module module;
        module.name = "math";
        add_function(module, "kernel", {});
        Builder b(module, 0);
        std::vector<Value> in;
        for (int k = 0; k < inputs; ++k)
            in.push_back(b.input(InputInfo{"x" + std::to_string(k), Type::F, Rate::Point, "", ""}));
        int output = 0;
        for (Value v : write(b, in)) b.output({.name = "y" + std::to_string(output++)}, v);
        b.finish();
        fault_ = verify(module);
        if (!fault_.empty()) return;
        for (const Function& f : module.functions) ops_ += int(f.insts.size());
        kernel_ = find_target(target)->emit(module, nullptr);
    }

    const std::string& fault() const { return fault_; }  // of the verifier, "" if none
    int instructions() const { return ops_; }

    // in[k] and out[k] are columns of equal length.
    std::vector<std::vector<float>> run(const std::vector<std::vector<float>>& in) const {
        size_t count = in[0].size();
        std::vector<Column> ins, outs;
        for (size_t k = 0; k < kernel_->outputs.size(); ++k) outs.emplace_back(padded(count));
        for (const InputInfo& info : kernel_->inputs) {
            const std::vector<float>& column = in[size_t(std::stoi(info.name.substr(1)))];
            ins.emplace_back(padded(count), column.back());
            std::copy(column.begin(), column.end(), ins.back().data());
        }
        std::vector<const float*> in_pointers;
        std::vector<float*> out_pointers;
        for (Column& c : ins) in_pointers.push_back(c.data());
        for (Column& c : outs) out_pointers.push_back(c.data());
        Column scratch(kernel_->scratch_bytes / sizeof(float) + 16);
        std::vector<uint8_t> faults(kernel_->fault_sites.size() + 1);
        KernelCall{
            .kernel = *kernel_,
            .count = count,
            .in = in_pointers,
            .out = out_pointers,
            .row_floats = padded(count),
            .scratch = {reinterpret_cast<std::byte*>(scratch.data()), kernel_->scratch_bytes},
            .faults = faults}
            .run();
        std::vector<std::vector<float>> result;
        for (Column& c : outs) result.emplace_back(c.data(), c.data() + count);
        return result;
    }

  private:
    // Floats aligned to 64 bytes.
    struct Column {
        explicit Column(size_t n, float value = 0)
            : memory(
                  static_cast<float*>(::operator new (n * sizeof(float), std::align_val_t{64}))) {
            std::fill_n(memory.get(), n, value);
        }
        Column(const Column& other) = delete;
        Column(Column&&) = default;
        float* data() { return memory.get(); }
        struct Free {
            void operator()(float* p) const { ::operator delete (p, std::align_val_t{64}); }
        };
        std::unique_ptr<float, Free> memory;
    };

    std::string fault_;
    int ops_ = 0;
    std::shared_ptr<Kernel> kernel_;
};

// Distance in units of the last place that a float has at the exact value; equal infinities and
// NaNs are 0 apart. An infinity counts as 2^128.
inline double ulp_error(float got, double exact) {
    if (std::isnan(got) || std::isnan(exact))
        return std::isnan(got) == std::isnan(exact) ? 0 : 1e30;
    if (std::fabs(exact) >= 0x1.ffffffp127)
        return std::isinf(got) && (got > 0) == (exact > 0) ? 0 : 1e30;
    if (std::isinf(got)) got = std::copysign(1.0f, got), exact /= 0x1p128;
    int exponent = exact == 0 ? -126 : std::max(std::ilogb(exact), -126);
    return std::fabs(double(got) - exact) / std::ldexp(1.0, exponent - 23);
}

// Reproducible samples: every bit pattern of a float, or uniform numbers.
struct Samples {
    uint64_t state = 0x9e3779b97f4a7c15u;
    uint32_t next() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return uint32_t(state >> 32);
    }
    float uniform(float lo, float hi) { return lo + (hi - lo) * float(next() * 0x1p-32); }
    float pattern() { return std::bit_cast<float>(next()); }
};

inline std::vector<float> edge_values() {
    std::vector<float> edges = {
        0.0f,      -0.0f,   1e-45f,      1.17549435e-38f, 1e-30f,   1e-7f,
        0.25f,     0.5f,    0.70710678f, 0.99999994f,     1.0f,     1.0000001f,
        1.5f,      2.0f,    3.14159274f, 1.57079637f,     10.0f,    87.5f,
        88.72284f, 89.0f,   103.97f,     104.5f,          127.9f,   128.0f,
        150.0f,    8191.9f, 8192.1f,     16777216.0f,     1e7f,     1e9f,
        3e9f,      1e20f,   1e30f,       3.40282347e38f,  HUGE_VALF};
    size_t positive = edges.size();
    for (size_t i = 0; i < positive; ++i) edges.push_back(-edges[i]);
    edges.push_back(std::nanf(""));
    return edges;
}

}  // namespace kinora::jit::testing
