// skin/influences_p.h: influences after repair.
#pragma once

#include <vector>

#include "skin/skin.h"

namespace kinora::skin {

struct Influence {
    uint32_t offset;  // of the joint's matrix in the palette, in floats
    float weight;
};

// Per vertex at least one influence; vertex v has those in [first[v], first[v + 1]).
struct CleanInfluences {
    std::vector<uint32_t> first;
    std::vector<Influence> influences;
    size_t count() const { return first.size() - 1; }
};
CleanInfluences clean_influences(const InfluenceSource& source, SkinRepairs& repairs);

// Where influence `round` of a vertex lies among a block's entries (see InfluenceBlocks).
constexpr uint32_t entry_of(uint32_t rounds, uint32_t round, uint32_t vertex) {
    uint32_t set = round / 4 * 4;
    uint32_t width = rounds - set < 4 ? rounds - set : 4;
    return set * 16 + vertex * width + (round - set);
}

// The influences of vertices[0], vertices[1], ... blocked; all in order if `vertices` is null.
InfluenceBlocks block_influences(const CleanInfluences& clean,
                                 const std::vector<uint32_t>* vertices);

}  // namespace kinora::skin
