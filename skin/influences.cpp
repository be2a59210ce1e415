// skin/influences.cpp: repairs a document's weights and lays them out for the kernels.
#include <algorithm>
#include <cmath>

#include "skin/influences_p.h"

namespace kinora::skin {
namespace {

constexpr uint32_t kMatrixFloats = sizeof(JointMatrix) / sizeof(float);
constexpr double kSumTolerance = 1e-3;  // docs/numerics.md#skins: sums nearer to 1 need no warning

struct RawInfluence {
    uint32_t offset;
    double weight;
};

// Joint -1 is palette entry 0, joint j entry j + 1. Influences of weight 0 are left out.
void collect(const InfluenceSource& source, size_t vertex, std::vector<RawInfluence>& raw,
             SkinRepairs& repairs) {
    raw.clear();
    size_t available = std::min(source.joints.size(), source.weights.size());
    size_t begin = std::min<size_t>(source.first[vertex], available);
    size_t end = std::min<size_t>(source.first[vertex + 1], available);
    for (size_t i = begin; i < end; ++i) {
        int64_t joint = source.joints[i];
        double weight = source.weights[i];
        if (joint < -1 || joint >= source.joint_count) {
            ++repairs.joint_range;
        } else if (!std::isfinite(weight)) {
            ++repairs.non_finite;
        } else if (weight != 0) {
            raw.push_back({static_cast<uint32_t>(joint + 1) * kMatrixFloats, weight});
        }
    }
}

double sum_of(const std::vector<RawInfluence>& raw) {
    double sum = 0;
    for (const RawInfluence& r : raw) sum += r.weight;
    return sum;
}

void report_sum(double sum, SkinRepairs& repairs) {
    if (std::abs(sum - 1) <= kSumTolerance) return;
    ++repairs.weight_sum;
    if (std::abs(sum - 1) > std::abs(repairs.worst_sum - 1)) repairs.worst_sum = sum;
}

// Keeps the `limit` largest weights in their order.
void keep_largest(std::vector<RawInfluence>& raw, uint32_t limit, SkinRepairs& repairs) {
    if (limit == 0 || raw.size() <= limit) return;
    double total = sum_of(raw);
    while (raw.size() > limit) {
        auto least = std::min_element(raw.begin(), raw.end(), [](auto& a, auto& b) {
            return std::abs(a.weight) < std::abs(b.weight);
        });
        ++repairs.dropped;
        repairs.largest_dropped =
            std::max(repairs.largest_dropped, std::abs(least->weight / total));
        raw.erase(least);
    }
}

// To sum 1; the largest takes up what rounding to float leaves, so a vertex far from its joint
// does not drift.
void append_normalised(const std::vector<RawInfluence>& raw, double sum,
                       std::vector<Influence>& out) {
    size_t begin = out.size(), largest = begin;
    double rest = 1;
    for (const RawInfluence& r : raw) {
        out.push_back({r.offset, static_cast<float>(r.weight / sum)});
        rest -= out.back().weight;
        if (std::abs(out.back().weight) > std::abs(out[largest].weight)) largest = out.size() - 1;
    }
    out[largest].weight = static_cast<float>(out[largest].weight + rest);
}

}  // namespace

CleanInfluences clean_influences(const InfluenceSource& source, SkinRepairs& repairs) {
    CleanInfluences clean;
    clean.first.push_back(0);
    uint32_t root = source.root_joint < source.joint_count ? source.root_joint + 1 : 0;
    std::vector<RawInfluence> raw;
    size_t vertices = source.first.empty() ? 0 : source.first.size() - 1;
    for (size_t v = 0; v < vertices; ++v) {
        collect(source, v, raw, repairs);
        double sum = sum_of(raw);
        if (std::abs(sum) < 1e-12) {  // also weights that cancel: nothing to scale to 1
            ++repairs.unweighted;
            raw.assign(1, {root * kMatrixFloats, 1.0});
            sum = 1;
        }
        report_sum(sum, repairs);
        keep_largest(raw, source.max_influences, repairs);
        repairs.most_influences =
            std::max(repairs.most_influences, static_cast<uint32_t>(raw.size()));
        if (source.normalise) {
            append_normalised(raw, sum_of(raw), clean.influences);
        } else {
            for (const RawInfluence& r : raw)
                clean.influences.push_back({r.offset, static_cast<float>(r.weight)});
        }
        clean.first.push_back(static_cast<uint32_t>(clean.influences.size()));
    }
    return clean;
}

InfluenceBlocks block_influences(const CleanInfluences& clean,
                                 const std::vector<uint32_t>* vertices) {
    constexpr uint32_t kBlock = InfluenceBlocks::kBlock;
    InfluenceBlocks blocks;
    blocks.count = vertices ? vertices->size() : clean.count();
    blocks.first.push_back(0);
    for (size_t begin = 0; begin < blocks.count; begin += kBlock) {
        auto lanes = static_cast<uint32_t>(std::min<size_t>(kBlock, blocks.count - begin));
        auto influences = [&](uint32_t lane) {
            size_t vertex = vertices ? (*vertices)[begin + lane] : begin + lane;
            return std::span(clean.influences)
                .subspan(clean.first[vertex], clean.first[vertex + 1] - clean.first[vertex]);
        };
        uint32_t rounds = 0;
        for (uint32_t lane = 0; lane < lanes; ++lane)
            rounds = std::max(rounds, static_cast<uint32_t>(influences(lane).size()));
        size_t at = blocks.weights.size();
        blocks.weights.resize(at + size_t{rounds} * kBlock, 0.0f);
        blocks.offsets.resize(at + size_t{rounds} * kBlock, 0);
        for (uint32_t lane = 0; lane < lanes; ++lane) {
            auto own = influences(lane);
            for (uint32_t round = 0; round < rounds; ++round) {
                size_t entry = at + entry_of(rounds, round, lane);
                blocks.weights[entry] = round < own.size() ? own[round].weight : 0;
                blocks.offsets[entry] = own[round < own.size() ? round : 0].offset;
            }
        }
        blocks.first.push_back(blocks.first.back() + rounds);
    }
    blocks.weights.resize(blocks.weights.size() + 3, 0.0f);
    return blocks;
}

}  // namespace kinora::skin
