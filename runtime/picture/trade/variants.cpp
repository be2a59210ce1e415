// runtime/picture/trade/variants.cpp: presets, knobs around two of them, and a Latin hypercube.
#include "runtime/picture/trade/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "runtime/base/check.h"

namespace kinora {

namespace {

constexpr size_t kPreview = 1, kFinal = 2;
constexpr int kFewSamples = 8;  // up to these a variant is compared with preview

class VariantList {
  public:
    void add(Variant variant) {
        if (known_.insert(knob_texts(variant.quality)).second) rows.push_back(std::move(variant));
    }
    std::vector<Variant> rows;

  private:
    std::set<std::string> known_;
};

void add_presets(VariantList& list) {
    for (size_t p = 0; p < kPresets; ++p)
        list.add({.name = kPresetNames[p],
                  .base = p < kFinal ? kPreview : kFinal,
                  .quality = qualities()[p]});
}

void add_knobs(VariantList& list, size_t base) {
    for (const Knob& knob : knobs())
        for (std::string_view setting : knob.settings) {
            Variant variant{
                .kind = VariantKind::Knob,
                .name = fmt::format("{} {}={}", kPresetNames[base], knob.option, setting),
                .base = base,
                .knob = &knob,
                .setting = std::string(setting),
                .quality = qualities()[base]};
            CHECK(set_knob(knob, setting, variant.quality));
            list.add(std::move(variant));
        }
}

// 0 .. count - 1 in an order of its own for each seed.
std::vector<size_t> shuffled(size_t count, uint32_t seed) {
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t(0));
    std::mt19937 random(seed);
    for (size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
}

// Those of a knob that a combination may have.
std::vector<std::string_view> settings_for(const Knob& knob, const CombinationRequest& request) {
    std::vector<std::string_view> settings = knob.settings;
    if (knob.option == "spp")
        std::erase_if(settings, [&](std::string_view setting) {
            return *knob_value(knob, setting) > double(request.most_samples);
        });
    return settings;
}

bool is_fixed(const Knob& knob, const CombinationRequest& request) {
    return std::ranges::find(request.fixed, &knob) != request.fixed.end();
}

}  // namespace

const char* variant_kind_name(VariantKind kind) {
    constexpr const char* kNames[] = {"preset", "knob", "combination"};
    return kNames[size_t(kind)];
}

std::vector<Variant> trade_variants() {
    VariantList list;
    add_presets(list);
    add_knobs(list, kFinal);
    add_knobs(list, kPreview);
    return std::move(list.rows);
}

void add_combinations(std::vector<Variant>& variants, const CombinationRequest& request) {
    std::vector<Quality> made(request.count, qualities()[kFinal]);
    for (size_t k = 0; k < knobs().size(); ++k) {
        const Knob& knob = knobs()[k];
        std::vector<std::string_view> settings = settings_for(knob, request);
        if (settings.empty() || is_fixed(knob, request)) continue;
        std::vector<size_t> order = shuffled(request.count, uint32_t(k + 1));
        for (size_t i = 0; i < request.count; ++i)
            CHECK(set_knob(knob, settings[order[i] * settings.size() / request.count], made[i]));
    }
    VariantList list;
    for (Variant& variant : variants) list.add(std::move(variant));
    for (size_t i = 0; i < made.size(); ++i) {
        made[i].name = "";
        list.add({.kind = VariantKind::Combination,
                  .name = fmt::format("combination {}", i + 1),
                  .base = made[i].samples_per_pixel <= kFewSamples ? kPreview : kFinal,
                  .quality = made[i]});
    }
    variants = std::move(list.rows);
}

bool is_built_in(const Knob& knob) {
    return knob.stage != "sample" && knob.stage != "film";
}

std::string scene_key(const Quality& quality) {
    std::string key;
    for (const Knob& knob : knobs())
        if (is_built_in(knob)) key += knob_text(knob, quality) + " ";
    return key;
}

}  // namespace kinora
