// runtime/scene/build/instances/instances.cpp: the shader instances of a scene.
#include "runtime/scene/build/instances/instances.h"

#include <algorithm>

#include "runtime/scene/build/instances/imager.h"
#include "runtime/scene/build/instances/light_instances.h"
#include "runtime/scene/build/instances/output_planes.h"
#include "runtime/scene/build/instances/surface_instances.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

void add_once(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

// Outputs that gather statements read of what they hit.
std::vector<std::string> gathered_outputs(const SceneShaders& scene) {
    std::vector<std::string> result;
    for (const auto& instance : scene.shader_instances)
        for (const ShaderUse& layer : instance->layers)
            for (const std::string& name : rsl::gathered_parameters(*layer.shader))
                add_once(result, name);
    return result;
}

// Light parameters that surfaces read.
std::vector<std::string> light_messages(const SceneShaders& scene) {
    std::vector<std::string> messages;
    for (const auto& instance : scene.shader_instances)
        for (const std::string& message : instance->lowered.light_messages)
            add_once(messages, message);
    return messages;
}

// Those that are not lights.
bool compile_instances(SceneShaders& scene, const OutputPlanes& outputs,
                       InstanceCompiler& compiler) {
    ShaderInstanceOptions of_surfaces;
    of_surfaces.aovs = outputs.outputs();
    of_surfaces.gathered = gathered_outputs(scene);
    bool ok = true;
    for (auto& instance : scene.shader_instances) {
        bool surface = instance->kind == ShaderInstanceKind::Surface;
        bool compiled =
            compiler.compile(*instance, surface ? of_surfaces : ShaderInstanceOptions());
        if (compiled) bind_planes(scene.outputs, *instance);
        ok &= compiled;
    }
    return ok;
}

std::span<const FileDisplay> displays_of(const Scene& scene) {
    const std::optional<FilePicture>& picture = scene.description->file_picture;
    if (!scene.options.displays || !picture) return {};
    return picture->displays;
}

bool add_lights(Scene& scene, InstanceCompiler& compiler) {
    SceneShaders& shaders = scene;
    return add_light_instances(scene, scene, shaders, scene.start, compiler,
                               light_messages(shaders));
}

}  // namespace

bool add_instances(Scene& scene, std::span<const SurfaceUse> uses, Diagnostics& diagnostics) {
    const SceneDescription& description = *scene.description;
    const CameraSource& camera = scene.cameras[scene.start.camera];
    SceneShapes& shapes = scene;
    SceneShaders& shaders = scene;
    InstanceCompiler compiler(scene, diagnostics);
    VertexInstances vertices(description, shapes, shaders, compiler);
    VolumeInstances volumes(description, shapes, shaders, diagnostics);
    SurfaceInstances surfaces(scene, shapes, shaders, vertices, volumes, diagnostics);
    for (size_t s = 0; s < shapes.surfaces.size(); ++s) surfaces.add(shapes.surfaces[s], uses[s]);
    add_atmosphere(description, camera, shaders);
    const std::vector<LightGroup> lights = single_lights(scene),
                                  groups = light_groups(scene, diagnostics);
    OutputPlanes outputs(shaders, scene.options.aovs, lights, groups, displays_of(scene),
                         imagers_of(description, camera), diagnostics);
    add_imager(description, camera, shaders, outputs.outputs());
    bool compiled = compile_instances(shaders, outputs, compiler);
    bool lit = add_lights(scene, compiler);
    for (size_t l = 0; l < shaders.shader_instances.size(); ++l)
        shaders.shader_instances[l]->index = uint32_t(l);
    return vertices.all_compiled() && compiled && lit;
}

bool add_light_instances(Scene& scene, Diagnostics& diagnostics) {
    InstanceCompiler compiler(scene, diagnostics);
    return add_lights(scene, compiler);
}

}  // namespace kinora
