// runtime/scene/shaders.h: the shaders of a scene, and the planes of the film that they fill.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct ShaderInstance;  // runtime/scene/shaders/shader_instance.h

// A plane of the film: one component of an output parameter of surfaces.
struct OutputPlane {
    std::string name;       // as the film has it: "glow.R", "dirt", "lamps.2.R"
    std::string parameter;  // "glow"
    uint32_t component = 0;
    int element = -1;     // of an array; -1: it is none
    bool in_file = true;  // false: only an imager or a display reads it
    bool depth = false;   // the nearest sample's counts, not the mean
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
