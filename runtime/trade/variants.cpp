// runtime/trade/variants.cpp: presets, knobs around two of them, and a Latin hypercube.
#include "runtime/trade/variants.h"

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

// Those of a knob that take no longer than final's samples.
std::vector<std::string_view> affordable_settings(const Knob& knob) {
    std::vector<std::string_view> settings = knob.settings;
    if (knob.option == "spp")
        std::erase_if(settings, [&](std::string_view setting) {
            return *knob_value(knob, setting) > double(qualities()[kFinal].samples_per_pixel);
        });
    return settings;
}

void add_combinations(VariantList& list, size_t count) {
    std::vector<Quality> made(count, qualities()[kFinal]);
    for (size_t k = 0; k < knobs().size(); ++k) {
        const Knob& knob = knobs()[k];
        std::vector<std::string_view> settings = affordable_settings(knob);
        std::vector<size_t> order = shuffled(count, uint32_t(k + 1));
        for (size_t i = 0; i < count; ++i)
            CHECK(set_knob(knob, settings[order[i] * settings.size() / count], made[i]));
    }
    for (size_t i = 0; i < count; ++i) {
        made[i].name = "";
        list.add({.kind = VariantKind::Combination,
                  .name = fmt::format("combination {}", i + 1),
                  .base = made[i].samples_per_pixel <= kFewSamples ? kPreview : kFinal,
                  .quality = made[i]});
    }
}

}  // namespace

const char* variant_kind_name(VariantKind kind) {
    constexpr const char* kNames[] = {"preset", "knob", "combination"};
    return kNames[size_t(kind)];
}

std::vector<Variant> trade_variants(size_t combinations) {
    VariantList list;
    add_presets(list);
    add_knobs(list, kFinal);
    add_knobs(list, kPreview);
    add_combinations(list, combinations);
    return std::move(list.rows);
}

bool is_built_in(const Knob& knob) {
    return knob.stage != "sample";
}

std::string scene_key(const Quality& quality) {
    std::string key;
    for (const Knob& knob : knobs())
        if (is_built_in(knob)) key += knob_text(knob, quality) + " ";
    return key;
}

}  // namespace kinora
