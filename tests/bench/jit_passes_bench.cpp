// tests/bench/jit_passes_bench.cpp: what each pass costs, and all of them. items = instructions.
#include <benchmark/benchmark.h>

#include "jit/compiler.h"
#include "jit/math/math.h"
#include "jit/passes/passes.h"

namespace kinora::jit {
namespace {

using Point3 = std::vector<Value>;

Point3 input3(Builder& b, const std::string& name) {
    Point3 p;
    for (const char* c : {".x", ".y", ".z"})
        p.push_back(b.input({name + c, Type::F, Rate::Point, name + c + ":du", name + c + ":dv"}));
    return p;
}
Value frame_input(Builder& b, const std::string& name) {
    return b.input({name, Type::F, Rate::Frame, "", ""});
}

// A point through a frame-rate matrix, as every shader begins.
Point3 transform(Builder& b, const Point3& p, const std::string& matrix) {
    Point3 q;
    for (int row = 0; row < 3; ++row) {
        Value m[4];
        for (int k = 0; k < 4; ++k) m[k] = frame_input(b, matrix + std::to_string(4 * row + k));
        q.push_back(b.fma(p[0], m[0], b.fma(p[1], m[1], b.fma(p[2], m[2], m[3]))));
    }
    return q;
}

// |noise| of six octaves in a loop, as `while (...)` lowers.
Value turbulence(Builder& b, const Point3& p) {
    Value running = b.begin_loop(b.m(true), b.fault_site({}, "budget"));
    Value k = b.loop_var(b.i(0)), freq = b.loop_var(b.f(1)), sum = b.loop_var(b.f(0));
    Point3 at;
    for (Value c : p) at.push_back(b.mul(c, freq));
    Value n = math::noise(b, running, at, 1)[0];
    Value amount = b.div(b.abs(b.fma(n, b.f(2), b.f(-1))), freq);
    Value next = b.iadd(k, b.i(1));
    b.end_loop(b.op(Op::ILt, next, b.i(6)),
               std::vector<Value>{next, b.mul(freq, b.f(2)), b.add(sum, amount)});
    return b.loop_out(sum);
}

// A marble or a wood: space change, turbulence, trigonometry, colours; `copies` of it in a row make
// the larger shaders. `bump` adds derivatives.
Module shader(int copies, bool bump) {
    Module m;
    m.name = "shader";
    add_function(m, "kernel", {});
    Builder b(m, 0);
    Point3 p = input3(b, "P"), n = input3(b, "N");
    for (int k = 0; k < copies; ++k) {
        std::string id = std::to_string(k);
        Point3 q = transform(b, p, "m" + id + ".");
        Value t = turbulence(b, q);
        auto tier = math::Tier::Fast;
        Value vein =
            math::pow(b, b.abs(math::sin(b, b.fma(t, frame_input(b, "a" + id), q[0]), tier)),
                      b.div(b.f(1), frame_input(b, "sharp" + id)), tier);
        if (bump) vein = b.add(vein, b.add(b.op(Op::Du, t), b.op(Op::Dv, t)));
        Value length =
            math::inversesqrt(b, b.fma(n[0], n[0], b.fma(n[1], n[1], b.mul(n[2], n[2]))), tier);
        for (int c = 0; c < 3; ++c)
            b.output({"C" + id + std::to_string(c), Type::F},
                     b.fma(vein, frame_input(b, "Kd" + std::to_string(c)),
                           b.mul(n[static_cast<size_t>(c)], length)));
    }
    b.finish();
    return m;
}

int64_t instructions(const Module& module) {
    size_t count = 0;
    for (const Function& f : module.functions) count += f.insts.size();
    return static_cast<int64_t>(count);
}

void time_pass(benchmark::State& state, const Module& before, void (*pass)(Module&)) {
    for (auto _ : state) {
        state.PauseTiming();
        Module module = before;
        state.ResumeTiming();
        pass(module);
    }
    state.SetItemsProcessed(state.iterations() * instructions(before));
    state.counters["before"] = static_cast<double>(instructions(before));
}

void time_optimize(benchmark::State& state, const Module& before) {
    int64_t after = 0;
    for (auto _ : state) {
        Module module = before, frame;
        optimize(module, &frame);
        after = instructions(module);
    }
    state.SetItemsProcessed(state.iterations() * instructions(before));
    state.counters["before"] = static_cast<double>(instructions(before));
    state.counters["after"] = static_cast<double>(after);
}

void time_compile(benchmark::State& state, const Module& before) {
    double emit_ms = 0, optimize_ms = 0;
    for (auto _ : state) {
        clear_cache();
        KernelPair pair = compile(before);
        emit_ms += pair.emit_ms;
        optimize_ms += pair.optimize_ms;
    }
    auto rounds = static_cast<double>(state.iterations());
    state.counters["emit_ms"] = emit_ms / rounds;
    state.counters["optimize_ms"] = optimize_ms / rounds;
}

void pass_hoist(Module& module) {
    hoist(module);
}

struct Stage {
    const char* name;
    void (*run)(Module&);
};
constexpr Stage kStages[] = {
    {"differentiate", differentiate},
    {"inline", inline_calls},
    {"dce", dce},
    {"fold", fold},
    {"unmask", unmask_uniform_loops},
    {"cse", cse},
    {"hoist", pass_hoist},
};

void register_all(const char* name, const Module& module) {
    std::string label = name;
    benchmark::RegisterBenchmark((label + "/optimize").c_str(), time_optimize, module);
    benchmark::RegisterBenchmark((label + "/compile").c_str(), time_compile, module);
    Module at = module;
    for (const Stage& stage : kStages) {
        benchmark::RegisterBenchmark((label + "/" + stage.name).c_str(), time_pass, at, stage.run);
        stage.run(at);
    }
}

}  // namespace
}  // namespace kinora::jit

int main(int argc, char** argv) {
    using namespace kinora::jit;
    register_all("marble", shader(1, false));
    register_all("marble_bump", shader(1, true));
    register_all("large", shader(4, true));
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
