// runtime/scene/shaders.h: the shaders of a scene, and the planes of the film that they fill.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/scene/aovs/aovs.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct ShaderInstance;  // runtime/scene/shaders/shader_instance.h

// A plane of the film: one component of an AOV, which is an output of surfaces or built in.
struct OutputPlane {
    std::string name;       // as the film has it: "glow.R", "dirt", "lamps.2.R", "uv.u"
    std::string layer;      // the AOV: "glow", "uv"
    std::string parameter;  // the kernel's output: "glow", "u"; "": no kernel fills it
    uint32_t component = 0;
    int element = -1;     // of an array; -1: it is none
    bool in_file = true;  // false: only an imager or a display reads it
    AovSource source = AovSource::Kernel;
    std::vector<uint32_t> lights = {};  // AovSource::Light: of Scene::lights
    raytrace::AovFilter filter = raytrace::AovFilter::Mean;
    float background = 0;
    bool half = false;   // in a file
    bool exact = false;  // not a digit may go in a file
};

struct SceneShaders {
    std::vector<std::shared_ptr<ShaderInstance>> shader_instances;
    // Displacements and transformations.
    std::vector<std::shared_ptr<ShaderInstance>> vertex_instances;
    uint32_t atmosphere = kNone;   // the volume outside all objects, into shader_instances
    bool own_atmospheres = false;  // some surfaces have one of their own
    uint32_t imager = kNone;  // what the finished picture is run through, into shader_instances
    std::vector<OutputPlane> outputs;
    // Interiors and exteriors, into shader_instances: ShaderInstance::volume is k + 1.
    std::vector<uint32_t> volumes;
};

}  // namespace kinora
