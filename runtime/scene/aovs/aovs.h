// runtime/scene/aovs/aovs.h: the planes that every material fills without a line of RSL, a row
// each, and what --aov takes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/film.h"

namespace kinora {

// What fills a plane.
enum class AovSource : uint8_t {
    Kernel,    // an output of the surface's kernel: a global of the language, or a shader's own
    Distance,  // numbers of a hit
    Surface,
    Object,
    Material,
    Motion,
    Albedo,  // of the shader, run once more in other light
    Emission,
    Direct,  // of the shader, run once more with some of its light
    Indirect,
    Light,  // of some lights: OutputPlane::lights
    Rest,
    Shadow,
    CryptoObject,  // names of hits by coverage
    CryptoMaterial,
    Samples,  // numbers of a pixel
    Variance,
    Cost,
};

// A built-in AOV. Its places and directions are in the camera's space, as RSL's "current".
struct AovRow {
    std::string_view name;
    std::string_view channels;  // behind the name, parted by spaces; "": one, without. A dot parts
                                // the name from a letter
    AovSource source;
    std::string_view outputs;  // Kernel: one of as many components, or one a channel
    raytrace::AovFilter filter;
    float background;  // where nothing is seen
    std::string_view what;
};
std::span<const AovRow> aov_rows();
const AovRow* find_aov_row(std::string_view name);  // null: there is none

// The words of a text that spaces part: AovRow::channels and outputs.
std::vector<std::string> parted_words(std::string_view text);
// The names of a row's channels: "P.X", "crypto_object00.R".
std::vector<std::string> channel_names(const AovRow& row);

// Whether a number of the row stands for a name, so that no digit of it may go.
bool is_exact(const AovRow& row);

// The word of a filter: "filter", "average", "nearest", "min", "max".
std::string_view word_of(raytrace::AovFilter filter);

// Before the name of a light: the AOV of what it lights.
inline constexpr std::string_view kLightAov = "light_";

// "all": every row and every output of the scene's shaders.
inline constexpr std::string_view kAllAovs = "all";

// NAME, and behind colons a filter, or half or float.
struct WantedAov {
    std::string name;
    std::optional<raytrace::AovFilter> filter = {};  // nothing: the row's, or the mean
    bool half = false;
};
// Nothing where a word behind a colon is none of these, or a row that is_exact() shall be half.
std::optional<WantedAov> parse_aov(std::string_view text);

// The rows as a table of Markdown.
std::string aov_table();

}  // namespace kinora
