// runtime/kinora/scene_error.cpp: which findings forbid a picture.
#include "runtime/kinora/scene_error.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

const FindingInfo* const kOfTheRequest[] = {
    &Code::CAMERA_UNKNOWN,       &Code::MATERIAL_UNKNOWN,   &Code::SHADER_UNKNOWN,
    &Code::SHADER_OF_OTHER_KIND, &Code::PARAM_UNKNOWN,      &Code::PARAM_VALUE,
    &Code::NODE_UNKNOWN,         &Code::AOV_UNKNOWN,        &Code::CAMERA_PARALLEL,
    &Code::ENVIRONMENT_SHADER,   &Code::AOV_FILTER_UNKNOWN,
};

}  // namespace

SceneError forbidding_error(const Diagnostics& diagnostics, SceneError otherwise) {
    for (const Finding& finding : diagnostics.findings()) {
        if (finding.severity != Severity::Error) continue;
        if (finding.info == &Code::INTERNAL_CHECK) return SceneError::Internal;
        if (std::string_view(finding.info->code).starts_with("RSL_")) return SceneError::Shader;
        if (std::ranges::find(kOfTheRequest, finding.info) != std::end(kOfTheRequest))
            return SceneError::Request;
    }
    return otherwise;
}

}  // namespace kinora
