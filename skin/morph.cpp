// skin/morph.cpp: morph targets as sparse or dense differences, summed chunk by chunk.
#include "skin/morph.h"

#include <algorithm>
#include <cmath>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"

namespace kinora::skin {
namespace {

constexpr size_t kMorphChunk = 1024;  // entries a task; a chunk stays in the nearest cache

vec4 padded(const vec3& v) {
    return {v.x, v.y, v.z, 0.0f};
}

std::vector<vec4> padded(std::span<const vec3> from) {
    std::vector<vec4> to;
    to.reserve(from.size());
    for (const vec3& v : from) to.push_back(padded(v));
    return to;
}

MorphDeltas make_deltas(MorphMethod method, std::span<const vec3> base,
                        std::span<const vec3> target) {
    size_t count = std::min(base.size(), target.size());
    MorphDeltas dense;
    for (size_t i = 0; i < count; ++i) {
        // the subtraction is exact where target and base are near, as they mostly are
        dense.deltas.push_back(
            padded(method == MorphMethod::Normalized ? target[i] - base[i] : target[i]));
    }
    MorphDeltas sparse;
    for (size_t i = 0; i < count; ++i) {
        if (dense.deltas[i] == vec4(0.0f)) continue;
        sparse.entries.push_back(static_cast<uint32_t>(i));
        sparse.deltas.push_back(dense.deltas[i]);
    }
    // also where a short target leaves entries of the base alone
    bool few = sparse.entries.size() * 2 < base.size() || count < base.size();
    return few ? sparse : dense;
}

void add_deltas(const MorphDeltas& target, float weight, size_t begin, size_t end,
                std::span<vec4> out) {
    if (target.entries.empty()) {
        if (target.deltas.empty()) return;
        for (size_t i = begin; i < end; ++i) out[i] += weight * target.deltas[i];
        return;
    }
    auto first = std::lower_bound(target.entries.begin(), target.entries.end(), begin);
    for (size_t k = static_cast<size_t>(first - target.entries.begin());
         k < target.entries.size() && target.entries[k] < end; ++k)
        out[target.entries[k]] += weight * target.deltas[k];
}

void make_unit(std::span<vec4> normals) {
    for (vec4& n : normals) {
        double x = n.x, y = n.y, z = n.z;
        double length = std::sqrt(x * x + y * y + z * z);
        double scale = std::isfinite(length) && length > 0 ? 1 / length : 0;
        n = scale > 0 ? vec4(x * scale, y * scale, z * scale, 0) : vec4(0.0f);
    }
}

// base + sum of w * delta over entries [begin, end) of one kind of data.
void sum_chunk(const Morph& morph, std::span<const vec4> base, MorphDeltas MorphTarget::*data,
               std::span<const double> weights, size_t begin, size_t end, std::span<vec4> out) {
    std::copy(base.begin() + begin, base.begin() + end, out.begin() + begin);
    size_t targets = std::min(weights.size(), morph.targets.size());
    for (size_t t = 0; t < targets; ++t) {
        auto weight = static_cast<float>(weights[t]);
        if (weight == 0 || !std::isfinite(weight)) continue;
        add_deltas(morph.targets[t].*data, weight, begin, end, out);
    }
}

}  // namespace

Morph build_morph(MorphMethod method, std::span<const vec3> base_positions,
                  std::span<const vec3> base_normals, std::span<const MorphTargetSource> targets,
                  uint32_t* mismatched) {
    Morph morph;
    morph.base_positions = padded(base_positions);
    morph.base_normals = padded(base_normals);
    uint32_t count = 0;
    for (const MorphTargetSource& target : targets) {
        count += target.positions.size() != base_positions.size() ||
                 (!target.normals.empty() && target.normals.size() != base_normals.size());
        morph.targets.push_back({make_deltas(method, base_positions, target.positions),
                                 make_deltas(method, base_normals, target.normals)});
    }
    if (mismatched) *mismatched += count;
    return morph;
}

void deform(const Morph& morph, std::span<const double> weights, std::span<vec4> positions,
            std::span<vec4> normals) {
    CHECK_EQ(positions.size(), morph.base_positions.size());
    CHECK_EQ(normals.size(), morph.base_normals.size());
    parallel_for(0, positions.size(), kMorphChunk, [&](size_t begin, size_t end) {
        sum_chunk(morph, morph.base_positions, &MorphTarget::positions, weights, begin, end,
                  positions);
    });
    parallel_for(0, normals.size(), kMorphChunk, [&](size_t begin, size_t end) {
        sum_chunk(morph, morph.base_normals, &MorphTarget::normals, weights, begin, end, normals);
        make_unit(normals.subspan(begin, end - begin));
    });
}

}  // namespace kinora::skin
