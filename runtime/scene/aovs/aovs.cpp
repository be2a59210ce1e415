// runtime/scene/aovs/aovs.cpp: the table of AOVs.
#include "runtime/scene/aovs/aovs.h"

#include <fmt/format.h>

#include <algorithm>

namespace kinora {

namespace {

using raytrace::AovFilter;
using enum AovSource;

constexpr float kFar = raytrace::kNoDepth;

// Six numbers of names, with the coverage of each.
constexpr std::string_view kRanks = "00.R 00.G 00.B 00.A 01.R 01.G 01.B 01.A 02.R 02.G 02.B 02.A";

constexpr AovRow kRows[] = {
    {"P", "X Y Z", Kernel, "P", AovFilter::Nearest, 0, "place, camera space"},
    {"N", "X Y Z", Kernel, "N", AovFilter::Nearest, 0,
     "normal that the surface is lit with, camera space"},
    {"Ng", "X Y Z", Kernel, "Ng", AovFilter::Nearest, 0, "normal of the triangle, camera space"},
    {"uv", "u v", Kernel, "u v", AovFilter::Nearest, 0, "parameters of the surface"},
    {"st", "s t", Kernel, "s t", AovFilter::Nearest, 0, "texture coordinates"},
    {"dPdu", "X Y Z", Kernel, "dPdu", AovFilter::Nearest, 0, "change of P along u, camera space"},
    {"depth", "", Distance, "", AovFilter::Nearest, kFar, "length of the camera's ray"},
    {"Z", "", Kernel, "z", AovFilter::Nearest, kFar, "distance from the camera's plane"},
    {"id", "", Surface, "", AovFilter::Nearest, 0, "number of the node's part with one material"},
    {"object_id", "", Object, "", AovFilter::Nearest, 0, "number of the node"},
    {"material_id", "", Material, "", AovFilter::Nearest, 0, "number of the material"},
    {"motion", "next.x next.y previous.x previous.y", Motion, "", AovFilter::Nearest, 0,
     "pixels to the place in the next frame, and from that in the previous one; x to the right, y "
     "up"},
    {"crypto_object", kRanks, CryptoObject, "", AovFilter::Mean, 0,
     "Cryptomatte of the nodes' paths"},
    {"crypto_material", kRanks, CryptoMaterial, "", AovFilter::Mean, 0,
     "Cryptomatte of the materials' names"},
    {"albedo", "R G B", Albedo, "", AovFilter::Mean, 0,
     "what the shader makes of one white light along N, without speculars"},
    {"emission", "R G B", Emission, "", AovFilter::Mean, 0,
     "what the shader shows without lights and rays; lamps and skies that are seen"},
    {"direct", "R G B", Direct, "", AovFilter::Mean, 0, "what lights add to that"},
    {"indirect", "R G B", Indirect, "", AovFilter::Mean, 0,
     "what rays add to that: reflections, refractions, bounces"},
    {"light_rest", "R G B", Rest, "", AovFilter::Mean, 0,
     "what lights and rays add that no other layer of the picture has"},
    {"shadow", "", Shadow, "", AovFilter::Mean, 0,
     "share of the unshadowed direct light that shadows take"},
    {"samples", "", Samples, "", AovFilter::Mean, 0, "samples of the pixel"},
    {"variance", "R G B", Variance, "", AovFilter::Mean, 0,
     "variance of the samples' colors; 0 with one sample"},
    {"cost", "", Cost, "", AovFilter::Mean, 0,
     "rays that the pixel took, those of its shaders and lights too"},
};

constexpr AovSource kExact[] = {Surface, Object, Material, CryptoObject, CryptoMaterial};
// What is no number of single samples has no other filter.
constexpr AovSource kOfPixels[] = {CryptoObject, CryptoMaterial, Samples, Variance, Cost};

struct FilterWord {
    AovFilter filter;
    std::string_view word;
};
constexpr FilterWord kFilters[] = {
    {AovFilter::Mean, "filter"}, {AovFilter::Average, "average"}, {AovFilter::Nearest, "nearest"},
    {AovFilter::Least, "min"},   {AovFilter::Most, "max"},
};

}  // namespace

std::span<const AovRow> aov_rows() {
    return kRows;
}

const AovRow* find_aov_row(std::string_view name) {
    const auto* found = std::ranges::find(kRows, name, &AovRow::name);
    return found == std::end(kRows) ? nullptr : found;
}

std::vector<std::string> parted_words(std::string_view text) {
    std::vector<std::string> words;
    while (!text.empty()) {
        const size_t end = std::min(text.find(' '), text.size());
        words.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

std::vector<std::string> channel_names(const AovRow& row) {
    std::vector<std::string> names = parted_words(row.channels);
    for (std::string& name : names)
        name = fmt::format("{}{}{}", row.name, name[0] >= '0' && name[0] <= '9' ? "" : ".", name);
    if (names.empty()) names.emplace_back(row.name);
    return names;
}

std::string_view word_of(AovFilter filter) {
    return std::ranges::find(kFilters, filter, &FilterWord::filter)->word;
}

bool is_exact(const AovRow& row) {
    return std::ranges::count(kExact, row.source) > 0;
}

std::optional<WantedAov> parse_aov(std::string_view text) {
    const size_t name = std::min(text.find(':'), text.size());
    WantedAov wanted{.name = std::string(text.substr(0, name))};
    for (std::string_view rest = text.substr(name); !rest.empty();) {
        const std::string_view word = rest.substr(1, rest.find(':', 1) - 1);
        rest.remove_prefix(1 + word.size());
        const auto* found = std::ranges::find(kFilters, word, &FilterWord::word);
        if (found != std::end(kFilters))
            wanted.filter = found->filter;
        else if (word == "half" || word == "float")
            wanted.half = word == "half";
        else
            return {};
    }
    const AovRow* row = find_aov_row(wanted.name);
    if (wanted.half && row && is_exact(*row)) return {};
    if (wanted.filter && row && std::ranges::count(kOfPixels, row->source) > 0) return {};
    return wanted;
}

std::string aov_table() {
    constexpr size_t kShown = 4;  // channels
    std::string table =
        "| AOV | channels | filter | premultiplied | background | what |\n"
        "|---|---|---|---|---|---|\n";
    for (const AovRow& row : kRows) {
        const std::vector<std::string> names = channel_names(row);
        std::string channels;
        if (names.size() > kShown)
            channels = fmt::format("`{}` to `{}`", names.front(), names.back());
        else
            channels = fmt::format("`{}`", fmt::join(names, "` `"));
        table += fmt::format("| `{}` | {} | {} | {} | {:g} | {} |\n", row.name, channels,
                             word_of(row.filter), row.filter == AovFilter::Mean ? "yes" : "no",
                             row.background, row.what);
    }
    return table;
}

}  // namespace kinora
