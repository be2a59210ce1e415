// skin/narrowest.cpp: the volume of blended matrices.
#include "skin/narrowest.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "runtime/base/check.h"
#include "skin/influences_p.h"

namespace kinora::skin {
namespace {

dmat3 linear_part(const JointMatrix& m) {
    dmat3 linear;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) linear[c][r] = double(m.c[c][r]);
    return linear;
}

}  // namespace

double narrowest(const SkinMesh& skin, std::span<const JointMatrix> palette) {
    CHECK_EQ(palette.size(), skin.joint_count + 1);
    const InfluenceBlocks& blocks = skin.positions;
    double least = 1;
    for (size_t v = 0; v < blocks.count; ++v) {
        const size_t block = v / InfluenceBlocks::kBlock;
        const uint32_t first = blocks.first[block], rounds = blocks.first[block + 1] - first;
        dmat3 sum(0.0);
        double volume = 0;
        for (uint32_t round = 0; round < rounds; ++round) {
            const size_t entry = size_t(first) * InfluenceBlocks::kBlock +
                                 entry_of(rounds, round, uint32_t(v % InfluenceBlocks::kBlock));
            const double weight = double(blocks.weights[entry]);
            if (weight == 0) continue;
            const dmat3 joint =
                linear_part(palette[blocks.offsets[entry] / (sizeof(JointMatrix) / sizeof(float))]);
            sum += weight * joint;
            const double own = glm::determinant(joint);
            volume = own > 0 && volume >= 0 ? volume + weight * own : -1;
        }
        if (volume > 0)
            least = std::min(least, std::sqrt(std::max(0.0, glm::determinant(sum) / volume)));
    }
    return least;
}

}  // namespace kinora::skin
