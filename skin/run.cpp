// skin/run.cpp: runs a kernel over the blocks of a skin in parallel.
#include "skin/run_p.h"

#include <array>
#include <cstring>
#include <string_view>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "skin/deform_p.h"

namespace kinora::skin {
namespace {

constexpr size_t kSkinChunk = 64;  // blocks a task: 1024 vertices, a few microseconds

struct KernelChoice {
    const DeformKernel *linear, *dual;
    bool (*supported)();
};
const KernelChoice kChoices[] = {
#if defined(__x86_64__)
    {&kAvx512Kernel, &kDualAvx512Kernel, [] { return __builtin_cpu_supports("avx512f") != 0; }},
    {&kAvx2Kernel, &kDualAvx2Kernel,
     [] { return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0; }},
#endif
    {&kPortableKernel, &kDualPortableKernel, [] { return true; }},
};

struct Kernels {
    std::array<const KernelChoice*, std::size(kChoices)> usable;
    std::array<const char*, std::size(kChoices)> names;
    size_t count = 0;
};
const Kernels& kernels() {
    static const Kernels all = [] {
        Kernels found;
        for (const KernelChoice& choice : kChoices) {
            if (!choice.supported()) continue;
            found.usable[found.count] = &choice;
            found.names[found.count++] = choice.linear->name;
        }
        return found;
    }();
    return all;
}

// The views of one run over one set of blocks; positions, normals or neither may be empty.
struct Run {
    const InfluenceBlocks& blocks;
    const float* palette;
    std::span<const vec4> rest_positions, rest_normals;
    std::span<vec4> positions, normals;
};

const float* floats(std::span<const vec4> s, size_t at) {
    return s.empty() ? nullptr : &s[at].x;
}
float* floats(std::span<vec4> s, size_t at) {
    return s.empty() ? nullptr : &s[at].x;
}

DeformTask task_at(const Run& run, size_t block) {
    size_t at = block * InfluenceBlocks::kBlock;
    return {run.palette,
            run.blocks.first.data(),
            run.blocks.weights.data(),
            run.blocks.offsets.data(),
            floats(run.rest_positions, at),
            floats(run.rest_normals, at),
            floats(run.positions, at),
            floats(run.normals, at)};
}

// The last vertices are fewer than a block: the kernel works on copies.
void run_tail(const Run& run, DeformBlocks kernel, size_t block) {
    constexpr size_t kBlock = InfluenceBlocks::kBlock;
    alignas(64) std::array<float, 4 * kBlock> rest_p{}, rest_n{}, p, n;
    size_t bytes = (run.blocks.count - block * kBlock) * sizeof(vec4);
    DeformTask own = task_at(run, block), copy = own;
    if (own.rest_positions) std::memcpy(rest_p.data(), own.rest_positions, bytes);
    if (own.rest_normals) std::memcpy(rest_n.data(), own.rest_normals, bytes);
    copy.rest_positions = rest_p.data(), copy.rest_normals = rest_n.data();
    copy.positions = p.data(), copy.normals = n.data();
    kernel(copy, block, block + 1);
    if (own.positions) std::memcpy(own.positions, p.data(), bytes);
    if (own.normals) std::memcpy(own.normals, n.data(), bytes);
}

void run_blocks(const Run& run, DeformBlocks kernel) {
    size_t whole = run.blocks.count / InfluenceBlocks::kBlock;
    parallel_for(0, whole, kSkinChunk,
                 [&](size_t begin, size_t end) { kernel(task_at(run, begin), begin, end); });
    if (whole * InfluenceBlocks::kBlock < run.blocks.count) run_tail(run, kernel, whole);
}

const DeformKernel& find_kernel(const char* name, Blending blending) {
    const Kernels& all = kernels();
    for (size_t i = 0; i < all.count; ++i)
        if (std::string_view(name) == all.names[i])
            return blending == Blending::Dual ? *all.usable[i]->dual : *all.usable[i]->linear;
    CHECK(!"a kernel of this name that the CPU supports");
    return kPortableKernel;
}

}  // namespace

std::span<const char* const> deform_kernels() {
    return {kernels().names.data(), kernels().count};
}

void run_kernel(const char* name, Blending blending, const DeformArrays& a) {
    const DeformKernel& kernel = find_kernel(name, blending);
    CHECK_EQ(a.rest_positions.size(), a.skin.positions.count);
    CHECK_EQ(a.positions.size(), a.skin.positions.count);
    CHECK_EQ(a.rest_normals.size(), a.skin.normal_count);
    CHECK_EQ(a.normals.size(), a.skin.normal_count);
    Run run{a.skin.positions, a.palette, a.rest_positions, {}, a.positions, {}};
    if (a.skin.shared_normals) {
        run.rest_normals = a.rest_normals, run.normals = a.normals;
        return run_blocks(run, kernel.positions_and_normals);
    }
    run_blocks(run, kernel.positions);
    run_blocks({a.skin.normals, a.palette, {}, a.rest_normals, {}, a.normals}, kernel.normals);
}

}  // namespace kinora::skin
