// runtime/scene/gltf/document/loss_report.cpp: findings about what glTF cannot hold.
#include "runtime/scene/gltf/document/loss_report.h"

#include "runtime/scene/description/findings.h"

namespace kinora {

void LossReport::lost(const std::string& what, const std::string& why, Location where) {
    if (reported_.insert(what + why).second)
        diagnostics_.report(Code::CONVERT_LOST, where, what, why);
}

void LossReport::in_extras(const std::string& what, const std::string& why, Location where) {
    diagnostics_.report(Code::CONVERT_EXTRAS, where, what, why);
}

void LossReport::hidden(uint32_t nodes) {
    if (nodes) diagnostics_.report(Code::CONVERT_HIDDEN, Location{}, nodes);
}

void LossReport::sampled(uint32_t curves, double worst_error) {
    if (curves) diagnostics_.report(Code::CONVERT_SAMPLED, Location{}, curves, worst_error);
}

}  // namespace kinora
