// runtime/scene/description/morph_weights.cpp: morphs that change one another's results.
#include "runtime/scene/description/morph_weights.h"

#include <algorithm>
#include <cmath>

namespace kinora {

std::vector<uint32_t> morph_chain(const SceneDescription& description, uint32_t morph) {
    std::vector<uint32_t> chain;
    for (uint32_t m = morph; m != kNone; m = description.morphs[m].base) chain.push_back(m);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

size_t chain_targets(const SceneDescription& description, uint32_t morph) {
    size_t count = 0;
    for (uint32_t m = morph; m != kNone; m = description.morphs[m].base)
        count += description.morphs[m].targets.size();
    return count;
}

void morph_weights(const SceneDescription& description, std::span<const double> values,
                   uint32_t morph, std::span<double> out) {
    size_t end = out.size();
    double kept = 1;  // of what the morphs further in add
    for (uint32_t m = morph; m != kNone; m = description.morphs[m].base) {
        const MorphDefinition& definition = description.morphs[m];
        size_t count = definition.targets.size();
        end -= count;
        double sum = 0;
        for (size_t t = 0; t < count; ++t) {
            double weight =
                t < definition.weights.count ? values[definition.weights.offset + t] : 0;
            out[end + t] = kept * weight;
            if (std::isfinite(weight)) sum += weight;
        }
        if (!definition.relative) kept *= 1 - sum;
    }
}

}  // namespace kinora
