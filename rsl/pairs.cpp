// rsl/pairs.cpp: which optional parameters are results.
#include "rsl/pairs.h"

#include <algorithm>

#include "rsl/builtin.h"

namespace kinora::rsl {

namespace {

// Options of point file look-ups; every other name is a channel.
constexpr std::string_view kPointOptions[] = {"radius",       "coordsystem", "interpolate",
                                              "filterradius", "filterscale", "maxdepth",
                                              "lerp",         "samples"};
constexpr std::string_view kOcclusionOutputs[] = {"environmentdir"};

constexpr std::string_view kTextOptions[] = {"filter",         "label",    "distribution",
                                             "environmentmap", "filename", "coordsystem"};
constexpr std::string_view kNumberOptions[] = {
    "bias",   "maxdist", "samples",    "samplecone", "coneangle", "falloff", "falloffmode",
    "blur",   "sblur",   "tblur",      "width",      "swidth",    "twidth",  "fill",
    "radius", "source",  "samplebase", "estimator",  "gapbias"};

template <size_t N>
bool among(std::string_view name, const std::string_view (&list)[N]) {
    return std::find(list, list + N, name) != list + N;
}

}  // namespace

std::string_view pair_name(std::span<Expr* const> args, size_t value) {
    const auto* name = value > 0 ? as_if<StringExpr>(args[value - 1]) : nullptr;
    return name ? std::string_view(name->value) : std::string_view();
}

BaseType option_type(std::string_view name) {
    if (among(name, kTextOptions)) return BaseType::String;
    return among(name, kNumberOptions) ? BaseType::Float : BaseType::Invalid;
}

bool is_output_pair(const CallExpr& call, size_t value) {
    if (!call.builtin || value <= call.pairs || (value - call.pairs) % 2 == 0) return false;
    std::string_view name = pair_name(call.args, value);
    if (name.empty()) return false;
    if (call.builtin->effects & kChannelPairs) return !among(name, kPointOptions);
    return (call.builtin->effects & kTraces) && among(name, kOcclusionOutputs);
}

bool is_gather_output(std::string_view name) {
    return name.starts_with("surface:") || name.starts_with("ray:") ||
           name.starts_with("primitive:");
}

bool is_light_output(std::string_view name) {
    return name.starts_with("light:");
}

}  // namespace kinora::rsl
