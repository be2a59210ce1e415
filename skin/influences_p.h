// skin/influences_p.h: influences after repair.
#pragma once

#include <vector>

#include "skin/skin.h"

namespace kinora::skin {

struct Influence {
    uint32_t place;  // float offset of the joint's matrix in the palette
    float weight;
};

// Per vertex at least one influence; vertex v has those in [first[v], first[v + 1]).
struct CleanInfluences {
    std::vector<uint32_t> first;
    std::vector<Influence> influences;
    size_t count() const { return first.size() - 1; }
};
CleanInfluences clean_influences(const InfluenceSource& source, SkinRepairs& repairs);

// The influences of vertices[0], vertices[1], ... blocked; all in order if `vertices` is null.
InfluenceBlocks block_influences(const CleanInfluences& clean,
                                 const std::vector<uint32_t>* vertices);

}  // namespace kinora::skin
