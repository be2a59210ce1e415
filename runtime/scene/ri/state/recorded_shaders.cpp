// runtime/scene/ri/state/recorded_shaders.cpp: requests that bind shaders, within attribute blocks.
#include "runtime/scene/ri/state/recorded_shaders.h"

namespace kinora::ri {

void RecordedShaders::follow(const Call& call) {
    if (call.request == Request::AttributeBegin) blocks_.push_back(blocks_.back());
    if (call.request == Request::AttributeEnd && blocks_.size() > 1) blocks_.pop_back();
    auto& [surfaces, displacements] = blocks_.back();
    std::string shader(shader_of(call.request, call.arguments));
    if (call.request == Request::Surface) surfaces = {std::move(shader)};
    if (call.request == Request::Displacement) displacements = {std::move(shader)};
    if (call.request != Request::ShaderLayer) return;
    auto& names = call.arguments[0].string() == "displacement" ? displacements : surfaces;
    if (!names) names.emplace();
    names->push_back(std::move(shader));
}

const std::optional<std::vector<std::string>>& RecordedShaders::names(Request request) const {
    const Names& now = blocks_.back();
    return request == Request::Surface ? now.surfaces : now.displacements;
}

}  // namespace kinora::ri
