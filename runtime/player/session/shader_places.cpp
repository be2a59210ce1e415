// runtime/player/session/shader_places.cpp: materials, lights and pictures gone through.
#include "runtime/player/session/shader_places.h"

namespace kinora {

namespace {

struct Stack {
    const char* kind;
    const std::vector<ShaderUse>* uses;
};

// Those of a wearer. `target` "": the shader's own name.
void add_stack(const std::string& id, const std::string& name, const std::string& target,
               Stack stack, size_t count, std::vector<ShaderPlace>& to) {
    for (size_t k = 0; k < count; ++k) {
        const ShaderUse& use = (*stack.uses)[k];
        if (!use.shader) continue;
        const std::string kind = stack.kind + (k > 0 ? std::to_string(k + 1) : "");
        to.push_back({id + ":" + kind, name + " " + kind,
                      target.empty() ? std::string(use.shader->name) : target, &use});
    }
}

void add_picture(const std::string& id, const PictureShaders& picture,
                 std::vector<ShaderPlace>& to) {
    for (Stack stack : {Stack{"atmosphere", &picture.atmosphere}, {"imager", &picture.imagers}})
        add_stack(id, id, "", stack, stack.uses->size(), to);
}

void add_material(const MaterialDefinition& material, std::vector<ShaderPlace>& to) {
    if (material.id.empty()) return;
    const std::string& name = material.name.empty() ? material.id : material.name;
    for (Stack stack : {Stack{"surface", &material.surfaces},
                        {"displacement", &material.displacements},
                        {"transformation", &material.transformations},
                        {"interior", &material.interior},
                        {"exterior", &material.exterior},
                        {"light", &material.lights}}) {
        const bool seen = stack.uses == &material.surfaces && !stack.uses->empty();
        add_stack(material.id, name, material.id, stack, stack.uses->size() - seen, to);
    }
}

}  // namespace

std::vector<ShaderPlace> further_places(const SceneDescription& description) {
    std::vector<ShaderPlace> places;
    for (const MaterialDefinition& material : description.materials) add_material(material, places);
    for (const LightDefinition& light : description.lights) {
        const std::string& id = light.id.empty() ? light.name : light.id;
        if (!light.shader.shader || id.empty()) continue;
        places.push_back(
            {"light:" + id, (light.name.empty() ? id : light.name) + " light", id, &light.shader});
    }
    add_picture("scene", description.picture, places);
    for (const CameraDefinition& camera : description.cameras)
        if (const std::string& id = camera.id.empty() ? camera.name : camera.id; !id.empty())
            add_picture(id, camera.picture, places);
    return places;
}

std::vector<ShaderPlace> shader_places(const SceneDescription& description) {
    std::vector<ShaderPlace> places;
    for (const MaterialDefinition& material : description.materials)
        places.push_back({material.id, material.name.empty() ? material.id : material.name,
                          material.id,
                          material.surfaces.empty() ? nullptr : &material.surfaces.back()});
    for (ShaderPlace& place : further_places(description)) places.push_back(std::move(place));
    return places;
}

}  // namespace kinora
