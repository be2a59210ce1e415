// runtime/programs/render/quality_options.h: --quality, and an option for each knob.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/programs/common/command_line.h"
#include "runtime/programs/render/options.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

// A knob on the command line, by its kind.
struct GivenKnob {
    std::optional<double> choice, real;
    std::optional<int> whole;
};

// As they stand on the command line.
struct QualityGiven {
    std::string preset;
    std::vector<GivenKnob> knobs{kinora::knobs().size()};
    std::optional<size_t> dice_limit;
};

// The preset, single knobs of it, and how pixels are sampled.
void declare_quality(CLI::App& app, QualityGiven& given, RenderOptions& o);
// Throws CLI::Error where a value is out of its range.
void interpret_quality(const QualityGiven& given, RenderOptions& o);

// Throws CLI::Error with `what` the option takes. NaN is in no range.
void check_range(const char* option, double value, double low, double high, const char* what);

}  // namespace kinora
