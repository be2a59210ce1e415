// runtime/scene/vertices/weld.cpp: one table of the positions seen so far.
#include "runtime/scene/vertices/weld.h"

#include <algorithm>
#include <array>
#include <bit>

#include "runtime/base/memory/pages.h"
#include "runtime/base/parallel.h"

namespace kinora {

namespace {

constexpr uint32_t kFree = ~0u;
constexpr size_t kAhead = 16;  // slots that are fetched before they are needed
constexpr size_t kHashGrain = 16384;

using Bits = std::array<uint32_t, 3>;

Bits bits_of(const vec4& p) {
    auto bits = [](float x) { return std::bit_cast<uint32_t>(x + 0.0f); };  // -0 is 0
    return {bits(p.x), bits(p.y), bits(p.z)};
}

uint32_t hash_of(const Bits& bits) {
    uint64_t xy = (uint64_t(bits[0]) << 32 | bits[1]) * 0x9e3779b97f4a7c15ull;
    return uint32_t((((xy ^ xy >> 32) + bits[2]) * 0xd6e8feb86659fd93ull) >> 32);
}

}  // namespace

std::vector<uint32_t> weld(std::span<const vec4> positions) {
    std::vector<uint32_t> result;  // first the hashes
    resize_pages(result, positions.size());
    parallel_for(0, positions.size(), kHashGrain, [&](size_t begin, size_t end) {
        for (size_t p = begin; p < end; ++p) result[p] = hash_of(bits_of(positions[p]));
    });
    const size_t slots = std::bit_ceil(2 * positions.size() + 1);
    std::vector<uint32_t> first;
    resize_pages(first, slots, kFree);
    const int shift = 32 - std::min(32, std::countr_zero(slots));  // the highest bits mix best
    for (size_t p = 0; p < positions.size(); ++p) {
        if (p + kAhead < positions.size()) __builtin_prefetch(&first[result[p + kAhead] >> shift]);
        const Bits bits = bits_of(positions[p]);
        size_t at = result[p] >> shift;
        while (first[at] != kFree && bits_of(positions[first[at]]) != bits)
            at = (at + 1) & (slots - 1);
        if (first[at] == kFree) first[at] = uint32_t(p);
        result[p] = first[at];
    }
    return result;
}

}  // namespace kinora
