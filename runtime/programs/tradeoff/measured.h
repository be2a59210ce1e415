// runtime/programs/tradeoff/measured.h: the settings that an earlier --tradeoff found best.
#pragma once

#include <optional>
#include <string>

#include "runtime/picture/trade/target.h"
#include "runtime/scene/quality/quality.h"

namespace kinora {

// What the settings are wanted for.
struct MeasuredQuery {
    std::string file;         // tradeoff.json, or its folder
    std::string fingerprint;  // of the scene and options, as --tradeoff has them
    std::string target;       // "avx2"
    int threads = 1;
    double pixels = 0;  // of the pictures to come
    FrameTarget wanted;
};

struct MeasuredSettings {
    std::string name;  // "final", "combination 3"
    Quality quality;   // with its samples
    double ms = 0;     // wall time of a frame of that many pixels
    double error = 0;  // of the metric wanted
};

// Of a time: the row that errs least among those within it; of rows that the noise floor makes
// equal the fastest. Of an error: the fastest row that errs no more. Nothing, with the reason: the
// file cannot be read, is of another scene, or has no such row.
std::optional<MeasuredSettings> measured_settings(const MeasuredQuery& query, std::string& why_not);

}  // namespace kinora
