// tests/bench/jit_bench.cpp: how fast code is made, and how fast it runs: a marble of six octaves
// of noise, and a plastic over light records, both in IR. items = points, or IR instructions.
#include <benchmark/benchmark.h>

#include <cmath>

#include "jit/compiler.h"
#include "jit/ir/builder.h"
#include "jit/math/math.h"
#include "jit/passes/passes.h"
#include "tests/jit/run_kernel.h"

namespace kinora::jit {
namespace {

constexpr int kFields = 7;  // L, Cl, lit

InputInfo point(const char* name) {
    return {name, Type::F, Rate::Point, "", ""};
}

struct Vec {
    Value x, y, z;
};

Vec input3(Builder& b, const std::string& name) {
    return {b.input(point((name + ".x").c_str())), b.input(point((name + ".y").c_str())),
            b.input(point((name + ".z").c_str()))};
}
Value dot(Builder& b, Vec p, Vec q) {
    return b.fma(p.x, q.x, b.fma(p.y, q.y, b.mul(p.z, q.z)));
}
Vec scale(Builder& b, Vec p, Value s) {
    return {b.mul(p.x, s), b.mul(p.y, s), b.mul(p.z, s)};
}
Vec normalize(Builder& b, Vec p) {
    return scale(b, p, math::inversesqrt(b, dot(b, p, p), math::Tier::Fast));
}

// Sum of Kd (N.L) Cl + Ks specular over the records of set 0.
Module plastic() {
    Module m;
    m.name = "plastic";
    add_function(m, "kernel", {});
    Builder b(m, 0);
    m.frame_slots = 8;
    Vec n = normalize(b, input3(b, "N"));
    Vec i = normalize(b, input3(b, "I"));
    auto frame = [&](int slot) { return b.op(Op::FrameLoad, kNone, kNone, kNone, slot); };
    Value zero = b.i(0);
    Value count = b.op(Op::RecordCount, zero);
    Value running = b.begin_loop(b.op(Op::ILt, zero, count), b.fault_site({}, "budget"));
    Value k = b.loop_var(zero);
    Vec diffuse = {b.loop_var(b.f(0)), b.loop_var(b.f(0)), b.loop_var(b.f(0))};
    Vec specular = {b.loop_var(b.f(0)), b.loop_var(b.f(0)), b.loop_var(b.f(0))};
    auto field = [&](int f) { return b.op(Op::RecordField, zero, k, kNone, f); };
    Vec l = normalize(b, {field(0), field(1), field(2)});
    Vec cl = {field(3), field(4), field(5)};
    Value facing = b.max(dot(b, n, l), b.f(0));
    Vec h = normalize(b, {b.sub(l.x, i.x), b.sub(l.y, i.y), b.sub(l.z, i.z)});
    Value shine = b.max(dot(b, n, h), b.f(0));
    Value spec = math::pow(b, shine, frame(0), math::Tier::Fast);
    Value lit = b.gt(dot(b, n, l), b.f(0));
    auto add = [&](Value sum, Value weight, Value color) {
        return b.select(lit, b.fma(weight, color, sum), sum);
    };
    std::vector<Value> next = {b.iadd(k, b.i(1))};
    for (auto [sum, c] : {std::pair{diffuse.x, cl.x}, {diffuse.y, cl.y}, {diffuse.z, cl.z}})
        next.push_back(add(sum, facing, c));
    for (auto [sum, c] : {std::pair{specular.x, cl.x}, {specular.y, cl.y}, {specular.z, cl.z}})
        next.push_back(add(sum, spec, c));
    b.end_loop(b.logical_and(running, b.op(Op::ILt, next[0], count)), next);
    Value d[] = {b.loop_out(diffuse.x), b.loop_out(diffuse.y), b.loop_out(diffuse.z)};
    Value s[] = {b.loop_out(specular.x), b.loop_out(specular.y), b.loop_out(specular.z)};
    const char* names[] = {"Ci.r", "Ci.g", "Ci.b"};
    for (int c = 0; c < 3; ++c)
        b.output({names[c], Type::F}, b.fma(d[c], frame(1 + c), b.mul(s[c], frame(4 + c))));
    b.finish();
    return m;
}

// Upstill's marble: six octaves of absolute noise, a colour from their sum.
Module marble() {
    Module m;
    m.name = "marble";
    add_function(m, "kernel", {});
    Builder b(m, 0);
    m.frame_slots = 4;
    Vec p = input3(b, "P");
    Value six = b.i(6);
    Value running = b.begin_loop(b.op(Op::ILt, b.i(0), six), b.fault_site({}, "budget"));
    Value k = b.loop_var(b.i(0));
    Value freq = b.loop_var(b.f(1));
    Value turbulence = b.loop_var(b.f(0));
    Vec q = scale(b, p, freq);
    Value at[] = {q.x, q.y, q.z};
    Value noise = math::noise(b, running, at, 1)[0];
    Value amount = b.div(b.abs(b.fma(noise, b.f(2), b.f(-1))), freq);
    Value next_k = b.iadd(k, b.i(1));
    Value next[] = {next_k, b.mul(freq, b.f(2)), b.add(turbulence, amount)};
    b.end_loop(b.op(Op::ILt, next_k, six), next);
    Value t = b.loop_out(turbulence);
    Value vein = b.max(math::sin(b, b.fma(t, b.f(8), p.x), math::Tier::Fast), b.f(0));
    const char* names[] = {"Ci.r", "Ci.g", "Ci.b"};
    for (int c = 0; c < 3; ++c)
        b.output({names[c], Type::F}, b.mul(vein, b.op(Op::FrameLoad, kNone, kNone, kNone, c)));
    b.finish();
    return m;
}

// A long straight program of 2000 instructions with much alive at once.
Module long_program() {
    Module m;
    m.name = "long";
    add_function(m, "kernel", {});
    Builder b(m, 0);
    std::vector<Value> v;
    for (int k = 0; k < 8; ++k) v.push_back(b.input(point(("x" + std::to_string(k)).c_str())));
    uint32_t seed = 1;
    auto any = [&] {
        seed = seed * 1664525 + 1013904223;
        return v[v.size() - 1 - (seed >> 16) % std::min<size_t>(v.size(), 40)];
    };
    while (m.functions[0].insts.size() < 1990) {
        switch (seed >> 20 & 3) {
            case 0:
                v.push_back(b.fma(any(), any(), any()));
                break;
            case 1:
                v.push_back(b.add(any(), any()));
                break;
            case 2:
                v.push_back(b.mul(any(), b.f(static_cast<float>(seed >> 24))));
                break;
            default:
                v.push_back(b.select(b.lt(any(), any()), any(), any()));
                break;
        }
    }
    for (int k = 0; k < 8; ++k) b.output({"o" + std::to_string(k), Type::F}, any());
    b.finish();
    return m;
}

Module optimized(Module m) {
    inline_calls(m);
    fold(m);
    cse(m);
    dce(m);
    return m;
}

void compile(benchmark::State& state, const Module& module, const Target& target) {
    size_t bytes = 0, insts = 0;
    for (const Function& f : module.functions) insts += f.insts.size();
    for (auto _ : state) bytes = target.emit(module, nullptr)->code_bytes;
    state.counters["code_bytes"] = static_cast<double>(bytes);
    state.counters["ir"] = static_cast<double>(insts);
    state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(insts));
}

// One light record a set, all its columns alive in cache.
struct Lights {
    explicit Lights(size_t points, int lights) {
        for (int k = 0; k < lights * kFields; ++k) {
            auto& column = columns.emplace_back(points);
            for (size_t p = 0; p < points; ++p)
                column.data[p] = std::sin(static_cast<float>(p * 7 + static_cast<size_t>(k)));
            pointers.push_back(column.data);
        }
        for (int k = 0; k < lights; ++k)
            records.push_back({pointers.data() + k * kFields, pointers[0]});
        set = {lights, records.data()};
    }
    std::vector<test::AlignedFloats> columns;
    std::vector<const float*> pointers;
    std::vector<Record> records;
    RecordSet set;
};

void run(benchmark::State& state, const Module& module, const Target& target) {
    auto count = static_cast<size_t>(state.range(0));
    auto kernel = target.emit(module, nullptr);
    Lights lights(count, 2);
    std::vector<test::AlignedFloats> rows;
    std::vector<const float*> in;
    std::vector<float*> out;
    for (size_t k = 0; k < kernel->inputs.size(); ++k) {
        auto& row = rows.emplace_back(count);
        for (size_t p = 0; p < count; ++p)
            row.data[p] = 4 * std::cos(static_cast<float>(p * 3 + k * 5));
        in.push_back(row.data);
    }
    for (size_t k = 0; k < kernel->outputs.size(); ++k)
        out.push_back(rows.emplace_back(count).data);
    test::AlignedFloats frame(8), scratch(kernel->scratch_bytes / 4);
    for (int k = 0; k < 8; ++k) frame.data[k] = 0.5f + static_cast<float>(k) * 2;
    std::vector<uint8_t> fault(kernel->fault_sites.size());
    CheckedCall call(
        {.kernel = *kernel,
         .count = count,
         .in = in,
         .out = out,
         .row_floats = count,
         .frame = {frame.data, frame.size},
         .scratch = {reinterpret_cast<std::byte*>(scratch.data), kernel->scratch_bytes},
         .faults = fault,
         .record_sets = {&lights.set, 1}});
    for (auto _ : state) call.run();
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace
}  // namespace kinora::jit

int main(int argc, char** argv) {
    using namespace kinora::jit;
    static const std::pair<const char*, Module> kModules[] = {
        {"marble", optimized(marble())},
        {"plastic", optimized(plastic())},
        {"long", optimized(long_program())},
    };
    for (const auto& [name, module] : kModules)
        for (const Target& target : targets()) {
            if (!target.supported()) continue;
            std::string label = std::string(name) + "/" + target.name;
            benchmark::RegisterBenchmark(("compile/" + label).c_str(),
                                         [&](benchmark::State& s) { compile(s, module, target); });
            benchmark::RegisterBenchmark(("run/" + label).c_str(),
                                         [&](benchmark::State& s) { run(s, module, target); })
                ->Arg(16)
                ->Arg(4096);
        }
    benchmark::Initialize(&argc, argv);
    if (argc > 1 && std::string_view(argv[1]) == "asm") {
        for (const auto& [name, module] : kModules)
            for (const Target& target : targets()) {
                std::string text;
                if (target.supported()) target.emit(module, &text);
                printf("==== %s %s\n%s", name, target.name, text.c_str());
            }
        return 0;
    }
    benchmark::RunSpecifiedBenchmarks();
}
