// runtime/scene/description/displacements.cpp: which shaders displace what a material is on.
#include "runtime/scene/description/displacements.h"

#include <algorithm>

namespace kinora {

namespace {

// The topmost; null: none.
const ShaderUse* displacing_surface(const MaterialDefinition& material) {
    const auto& surfaces = material.surfaces;
    auto found = std::find_if(surfaces.rbegin(), surfaces.rend(), [](const ShaderUse& use) {
        return use.shader && use.shader->displacement;
    });
    return found == surfaces.rend() ? nullptr : &*found;
}

}  // namespace

bool surface_displaces(const MaterialDefinition& material) {
    return displacing_surface(material);
}

std::vector<ShaderUse> displacements_of(const MaterialDefinition& material) {
    const ShaderUse* surface = displacing_surface(material);
    if (!surface) return material.displacements;
    ShaderUse use = *surface;
    use.shader = surface->shader->displacement;
    std::erase_if(use.params, [&](const ParamSource& source) {
        return std::none_of(use.shader->parameters.begin(), use.shader->parameters.end(),
                            [&](const auto& parameter) { return parameter.name == source.name; });
    });
    return {use};
}

bool displaces(const MaterialDefinition& material) {
    return surface_displaces(material) || !material.displacements.empty();
}

}  // namespace kinora
