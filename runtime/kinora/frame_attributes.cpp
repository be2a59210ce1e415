// runtime/kinora/frame_attributes.cpp: matrices and time codes.
#include "runtime/kinora/frame_attributes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "runtime/scene/scene.h"
#include "runtime/scene/spaces.h"

namespace kinora {

namespace {

// GLM's columns are the rows of OpenEXR, whose vectors stand before matrices.
ExrAttribute matrix(const char* key, const dmat4& m) {
    ExrAttribute attribute{key, ExrValue::Matrix, {}};
    std::copy_n(glm::value_ptr(m), 16, attribute.numbers.begin());
    return attribute;
}

// SMPTE 12M counts up to 30 frames a second; a rate of 30000/1001 counts 30, none of them dropped.
std::optional<ExrAttribute> time_code(FrameRate rate, int64_t frame) {
    const auto per_second = int64_t(std::ceil(rate.value() - 1e-9));
    if (per_second > 30 || frame < 0) return {};
    const int64_t seconds = frame / per_second;
    return ExrAttribute{"timeCode",
                        ExrValue::TimeCode,
                        {double(seconds / 3600 % 24), double(seconds / 60 % 60),
                         double(seconds % 60), double(frame % per_second)}};
}

}  // namespace

std::vector<ExrAttribute> frame_attributes(const Scene& scene, const Pose& pose, FrameRate rate,
                                           int64_t frame) {
    const dmat4 camera = current_from_space(scene, pose, "world", kNone);
    const dmat4 ndc = glm::inverse(current_from_space(scene, pose, "NDC", kNone));
    std::vector<ExrAttribute> attributes{matrix("worldToCamera", camera),
                                         matrix("worldToNDC", ndc * camera),
                                         {"chromaticities",
                                          ExrValue::Chromaticities,
                                          {0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329}}};
    constexpr int64_t kMost = 1u << 31;
    if (rate.numerator < kMost && rate.denominator < kMost)
        attributes.push_back({"framesPerSecond",
                              ExrValue::Rational,
                              {double(rate.numerator), double(rate.denominator)}});
    if (auto code = time_code(rate, frame)) attributes.push_back(*code);
    return attributes;
}

}  // namespace kinora
