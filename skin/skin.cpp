// skin/skin.cpp: builds skins, and deforms them by blended matrices.
#include "skin/skin.h"

#include "runtime/base/check.h"
#include "skin/influences_p.h"
#include "skin/run_p.h"

namespace kinora::skin {
namespace {

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
    deform_with(deform_kernels()[0], skin, palette, rest_positions, rest_normals, positions,
                normals);
}

void deform_with(const char* kernel, const SkinMesh& skin, std::span<const JointMatrix> palette,
                 std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                 std::span<vec4> positions, std::span<vec4> normals) {
    CHECK_EQ(palette.size(), skin.joint_count + 1);
    run_kernel(kernel, Blending::Linear,
               {skin, &palette[0].c[0][0], rest_positions, rest_normals, positions, normals});
}

}  // namespace kinora::skin
