// tests/bench/skin_bench.cpp: skinning against a plain copy of the same bytes.
//
// 35 000 vertices (a 70 000-triangle character), 4 influences each, 60 joints, one thread. "Bytes"
// are what skinning must read (rest position, rest normal, weights, joint places) and write
// (position, normal). Two copies to hold it against, in the same run:
//   Copy/touching  memcpy of half of them: reads and writes together touch as many bytes
//   Copy/of        memcpy of them all
// The counter GB/s is bytes touched by time, comparable between Skin and Copy/touching.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <random>

#include "runtime/base/parallel.h"
#include "skin/dual_quaternion.h"
#include "skin/morph.h"
#include "skin/skin.h"

namespace kinora::skin {
namespace {

constexpr size_t kVertices = 35000;
constexpr uint32_t kJoints = 60;
constexpr size_t kRead = kVertices * (2 * sizeof(vec4) + 4 * (sizeof(float) + sizeof(uint32_t)));
constexpr size_t kWritten = kVertices * 2 * sizeof(vec4);

// Scene's buffers start on a cache line.
template <class T>
struct LineAllocator {
    using value_type = T;
    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}
    T* allocate(size_t n) {
        return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64}));
    }
    void deallocate(T* p, size_t) { ::operator delete (p, std::align_val_t{64}); }
    bool operator==(const LineAllocator&) const { return true; }
};
template <class T>
using Buffer = std::vector<T, LineAllocator<T>>;

struct Character {
    std::vector<JointMatrix> palette;
    Buffer<vec4> rest, normals, out_positions, out_normals;
    SkinMesh skin;
};

// Joints along a line, vertices in order along it: each is held by four joints near to it.
Character make_character(bool own_normal_index) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    Character c;
    std::vector<uint32_t> first{0}, normal_positions;
    std::vector<int32_t> joints;
    std::vector<double> weights;
    for (size_t v = 0; v < kVertices; ++v) {
        float along = float(v) / kVertices;
        c.rest.push_back({along * 2, unit(random), unit(random), 0});
        c.normals.push_back({unit(random) - 0.5f, unit(random), unit(random) - 0.5f, 0});
        for (int k = 0; k < 4; ++k) {
            joints.push_back(
                std::min<int>(int(along * kJoints) + int(4 * unit(random)), kJoints - 1));
            weights.push_back(unit(random) + 0.1);
        }
        first.push_back(uint32_t(joints.size()));
        normal_positions.push_back(uint32_t(v));
    }
    if (own_normal_index) std::swap(normal_positions[0], normal_positions[1]);
    c.skin = build_skin({first, joints, weights, kJoints}, normal_positions);
    c.palette.resize(kJoints + 1);
    for (uint32_t j = 0; j <= kJoints; ++j) {
        dmat4 turn(1.0);
        double angle = 0.05 * j;
        turn[0] = {std::cos(angle), std::sin(angle), 0, 0};
        turn[1] = {-std::sin(angle), std::cos(angle), 0, 0};
        c.palette[j] = joint_matrix(turn, {});
    }
    c.out_positions.resize(kVertices);
    c.out_normals.resize(kVertices);
    return c;
}

void count_bytes(benchmark::State& state, size_t bytes) {
    state.SetBytesProcessed(int64_t(state.iterations()) * int64_t(bytes));
    state.counters["vertices/s"] =
        benchmark::Counter(double(state.iterations()) * kVertices, benchmark::Counter::kIsRate);
}

void skin_with(benchmark::State& state, const char* kernel, bool own_normal_index) {
    set_thread_count(1);
    Character c = make_character(own_normal_index);
    for (auto _ : state) {
        deform_with(kernel, c.skin, c.palette, c.rest, c.normals, c.out_positions, c.out_normals);
        benchmark::ClobberMemory();
    }
    count_bytes(state, kRead + kWritten);
}

void skin_dual(benchmark::State& state, const char* kernel) {
    set_thread_count(1);
    Character c = make_character(false);
    std::vector<DualJoint> palette;
    for (const JointMatrix& m : c.palette) palette.push_back(dual_joint(m));
    for (auto _ : state) {
        deform_dual_with(kernel, c.skin, palette, c.rest, c.normals, c.out_positions,
                         c.out_normals);
        benchmark::ClobberMemory();
    }
    count_bytes(state, kRead + kWritten);
}

void copy(benchmark::State& state, size_t bytes, size_t counted) {
    Buffer<char> from(bytes, 1), to(bytes, 2);
    for (auto _ : state) {
        std::memcpy(to.data(), from.data(), bytes);
        benchmark::ClobberMemory();
    }
    count_bytes(state, counted);
}

void morph_targets(benchmark::State& state) {
    set_thread_count(1);
    Character c = make_character(false);
    std::vector<vec3> base(kVertices, vec3(1)), normals(kVertices, vec3(0, 0, 1));
    std::vector<vec3> moved(kVertices, vec3(2));
    std::vector<MorphTargetSource> targets(static_cast<size_t>(state.range(0)), {moved, normals});
    std::vector<double> weights(targets.size(), 0.1);
    Morph morph = build_morph(MorphMethod::Normalized, base, normals, targets);
    for (auto _ : state) {
        deform(morph, weights, c.out_positions, c.out_normals);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(morph_targets)->Arg(1)->Arg(4)->Arg(20)->Unit(benchmark::kMicrosecond);

void register_all() {
    auto add = [](const std::string& name, auto&&... args) {
        benchmark::RegisterBenchmark(name.c_str(), args...)->Unit(benchmark::kMicrosecond);
    };
    add("Copy/touching", copy, (kRead + kWritten) / 2, kRead + kWritten);
    add("Copy/of", copy, kRead + kWritten, 2 * (kRead + kWritten));
    for (const char* kernel : deform_kernels()) {
        add(std::string("Skin/") + kernel, skin_with, kernel, false);
        add(std::string("SkinDual/") + kernel, skin_dual, kernel);
        add(std::string("SkinOwnNormalIndex/") + kernel, skin_with, kernel, true);
    }
}

}  // namespace
}  // namespace kinora::skin

int main(int argc, char** argv) {
    kinora::skin::register_all();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
