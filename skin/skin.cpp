// skin/skin.cpp: builds skins, and runs the fastest kernel over their blocks in parallel.
#include "skin/skin.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "skin/deform_p.h"
#include "skin/influences_p.h"

namespace kinora::skin {
namespace {

constexpr size_t kSkinChunk = 64;  // blocks a task: 1024 vertices, a few microseconds

struct KernelChoice {
    const DeformKernel* kernel;
    bool (*supported)();
};
const KernelChoice kChoices[] = {
#if defined(__x86_64__)
    {&kAvx512Kernel, [] { return __builtin_cpu_supports("avx512f") != 0; }},
    {&kAvx2Kernel,
     [] { return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0; }},
#endif
    {&kPortableKernel, [] { return true; }},
};

struct Kernels {
    std::array<const DeformKernel*, std::size(kChoices)> usable;
    std::array<const char*, std::size(kChoices)> names;
    size_t count = 0;
};
const Kernels& kernels() {
    static const Kernels all = [] {
        Kernels found;
        for (const KernelChoice& choice : kChoices) {
            if (!choice.supported()) continue;
            found.usable[found.count] = choice.kernel;
            found.names[found.count++] = choice.kernel->name;
        }
        return found;
    }();
    return all;
}

// The views of one run over one set of blocks; positions, normals or neither may be empty.
struct Run {
    const InfluenceBlocks& blocks;
    const JointMatrix* palette;
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
    return {&run.palette->c[0][0],     run.blocks.first.data(),        run.blocks.weights.data(),
            run.blocks.offsets.data(), floats(run.rest_positions, at), floats(run.rest_normals, at),
            floats(run.positions, at), floats(run.normals, at)};
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

void deform_by(const DeformKernel& kernel, const SkinMesh& skin,
               std::span<const JointMatrix> palette, std::span<const vec4> rest_positions,
               std::span<const vec4> rest_normals, std::span<vec4> positions,
               std::span<vec4> normals) {
    CHECK_EQ(palette.size(), skin.joint_count + 1);
    CHECK_EQ(rest_positions.size(), skin.positions.count);
    CHECK_EQ(positions.size(), skin.positions.count);
    CHECK_EQ(rest_normals.size(), skin.normal_count);
    CHECK_EQ(normals.size(), skin.normal_count);
    Run run{skin.positions, palette.data(), rest_positions, {}, positions, {}};
    if (skin.shared_normals) {
        run.rest_normals = rest_normals, run.normals = normals;
        return run_blocks(run, kernel.positions_and_normals);
    }
    run_blocks(run, kernel.positions);
    run_blocks({skin.normals, palette.data(), {}, rest_normals, {}, normals}, kernel.normals);
}

// Whether normal i belongs to position i throughout.
bool is_identity(std::span<const uint32_t> normal_positions, size_t positions) {
    if (normal_positions.size() != positions || positions == 0) return false;
    for (size_t i = 0; i < positions; ++i)
        if (normal_positions[i] != i) return false;
    return true;
}

}  // namespace

SkinMesh build_skin(const InfluenceSource& source, std::span<const uint32_t> normal_positions,
                    SkinRepairs* repairs) {
    SkinRepairs own;
    SkinRepairs& counts = repairs ? *repairs : own;
    CleanInfluences clean = clean_influences(source, counts);
    SkinMesh skin;
    skin.joint_count = source.joint_count;
    skin.positions = block_influences(clean, nullptr);
    if (clean.count() == 0) return skin;  // normals without positions belong to nothing
    skin.normal_count = normal_positions.size();
    skin.shared_normals = is_identity(normal_positions, clean.count());
    if (skin.shared_normals) return skin;
    std::vector<uint32_t> vertices(normal_positions.begin(), normal_positions.end());
    for (uint32_t& vertex : vertices) {
        if (vertex < clean.count()) continue;
        ++counts.joint_range;
        vertex = 0;
    }
    skin.normals = block_influences(clean, &vertices);
    return skin;
}

void deform(const SkinMesh& skin, std::span<const JointMatrix> palette,
            std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
            std::span<vec4> positions, std::span<vec4> normals) {
    deform_by(*kernels().usable[0], skin, palette, rest_positions, rest_normals, positions,
              normals);
}

std::span<const char* const> deform_kernels() {
    return {kernels().names.data(), kernels().count};
}

void deform_with(const char* kernel, const SkinMesh& skin, std::span<const JointMatrix> palette,
                 std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                 std::span<vec4> positions, std::span<vec4> normals) {
    const Kernels& all = kernels();
    for (size_t i = 0; i < all.count; ++i)
        if (std::string_view(kernel) == all.names[i])
            return deform_by(*all.usable[i], skin, palette, rest_positions, rest_normals, positions,
                             normals);
    CHECK(!"a kernel of this name that the CPU supports");
}

}  // namespace kinora::skin
