// runtime/programs/convert/worn_shaders.cpp: which shader of the command line stands where.
#include "runtime/programs/convert/worn_shaders_p.h"

#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

using Stack = std::vector<ShaderUse>;
constexpr Stack MaterialDefinition::*kStacks[] = {
    &MaterialDefinition::transformations, &MaterialDefinition::displacements,
    &MaterialDefinition::surfaces, &MaterialDefinition::interior, &MaterialDefinition::lights};

// By material and stack, then by light; null where nothing stands.
std::vector<const rsl::Shader*> shaders_of(const SceneDescription& scene) {
    std::vector<const rsl::Shader*> shaders;
    for (const MaterialDefinition& material : scene.materials)
        for (auto stack : kStacks)
            shaders.push_back((material.*stack).empty() ? nullptr
                                                        : (material.*stack).front().shader.get());
    for (const LightDefinition& light : scene.lights) shaders.push_back(light.shader.shader.get());
    return shaders;
}

}  // namespace

void WornShaders::put(std::string_view wearer, std::string_view id, rsl::ShaderKind kind,
                      const std::string& given, Diagnostics& diagnostics) {
    auto [worn, fresh] =
        given_.try_emplace({std::string(wearer) + "#" + std::string(id), kind}, given);
    if (fresh) return;
    diagnostics.report(Code::CONVERT_STAGE_TWICE, Location{}, id, rsl::shader_kind_name(kind),
                       given, worn->second);
    worn->second = given;
}

bool put_shader(SceneDescription& scene, const std::string& pattern, const ShaderGiven& given,
                WornShaders& worn, Diagnostics& diagnostics) {
    std::vector<const rsl::Shader*> before = shaders_of(scene);
    if (!override_shader(scene, pattern, given, diagnostics)) return false;
    std::vector<const rsl::Shader*> after = shaders_of(scene);
    size_t at = 0;
    auto note = [&](std::string_view wearer, const std::string& id) {
        if (after[at] != before[at])
            worn.put(wearer, id, after[at]->kind, given.shader, diagnostics);
        ++at;
    };
    for (const MaterialDefinition& material : scene.materials)
        for (size_t s = 0; s < std::size(kStacks); ++s) note("material", material.id);
    for (const LightDefinition& light : scene.lights) note("light", light.id);
    return true;
}

}  // namespace kinora
