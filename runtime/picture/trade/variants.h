// runtime/picture/trade/variants.h: the settings of all knobs that a trade-off measures.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/quality/knobs.h"

namespace kinora {

enum class VariantKind : uint8_t { Preset, Knob, Combination };
const char* variant_kind_name(VariantKind kind);  // "preset"

struct Variant {
    VariantKind kind = VariantKind::Preset;
    std::string name{};  // "final", "final math=fast", "combination 3"
    size_t base = 0;     // the variant whose time its own is compared with: preview or final
    const Knob* knob = nullptr;  // of a knob: the one that differs from the base
    std::string setting{};       // and to what
    Quality quality{};
};

// The presets in their order, and each knob alone at each setting around `final` and `preview`.
// The same list each time, without two of the same settings.
std::vector<Variant> trade_variants();

// Combinations of settings: a Latin hypercube over the knobs.
struct CombinationRequest {
    size_t count = 24;
    int most_samples = 64;             // settings of --spp with more are left out
    std::vector<const Knob*> fixed{};  // these stay as `final` has them
};
// Adds them, without those that the list holds. The same ones for the same request.
void add_combinations(std::vector<Variant>& list, const CombinationRequest& request);

// Whether a scene must be built again for another setting of the knob; else it says only how
// samples are made or written.
bool is_built_in(const Knob& knob);
// Qualities with the same text have one scene.
std::string scene_key(const Quality& quality);

}  // namespace kinora
