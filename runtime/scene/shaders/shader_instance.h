// runtime/scene/shaders/shader_instance.h: a shader stack with its parameters, compiled: what
// surfaces wear and lights are.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/camera.h"
#include "rsl/lower/lower.h"
#include "rsl/model/kernel_keys.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/kernels/bound_kernel.h"
#include "runtime/scene/kernels/columns.h"
#include "runtime/scene/spaces.h"

namespace kinora {

struct Pose;
struct Scene;
struct SceneNodes;

// What frame-rate inputs are computed from.
struct FrameContext {
    const Scene& scene;       // what kernels look up
    const SceneNodes& nodes;  // its
    const Pose& pose;
    dvec3 eye{0.0};                          // in "current"
    const std::atomic<int>* stop = nullptr;  // KernelCall::stop
};

// Where a frame-rate input's number comes from, resolved by key once.
struct FrameInput {
    enum class Source : uint8_t {
        Fixed,    // `fixed`
        Value,    // values[index]
        Spatial,  // component `component` of a point-like parameter at values[index], brought
                  // from shader space to current
        Space,    // entry (row, column) of space `index`
        Time,
        Shutter,
        Near,
        Far,
        Eye,  // component `component`
    };
    Source source = Source::Fixed;
    float fixed = 0;
    uint32_t index = 0;
    uint32_t space = 0;     // Spatial: the look's "shader" among its spaces
    uint8_t component = 0;  // or row * 4 + column
    rsl::BaseType type = rsl::BaseType::Float;
    bool inverse = false;  // Space: from_current
};

struct ShaderInstance;

// A kernel whose frame-rate inputs come from a scene.
struct SceneKernel : BoundKernel {
    std::vector<FrameInput> inputs;  // of the frame kernel
};

// A shader instance in one frame: what its frame kernels gave.
struct InstanceFrame {
    std::vector<dmat4> current_from_space;  // of ShaderInstance::spaces
    FrameBlock full, opacity;
    uint64_t prints_asked = 0, prints_shown = 0;  // by the full kernel's, the last time
};

enum class ShaderInstanceKind : uint8_t {
    Surface,
    Light,
    Volume,
    Imager,
    Displacement,
    Transformation
};

// A parameter bound to vertex inputs.
struct VaryingParam {
    std::string name;      // the shader parameter
    std::string semantic;  // of the vertex input; "Pref" is the rest position
    uint32_t set = kNone;
    uint32_t layer = 0;
    uint32_t components = 1;
    uint32_t component = 0;  // first component of the vertex input (1 for the t of a texcoord)
    bool text = false;       // values are ids of interned texts, bit for bit
    bool array = false;  // of `components` numbers in all: no kernel reads it, shaders ask for it
    bool of_displacement() const { return semantic.starts_with("vertex:"); }
    // Value; du at column + components, dv at column + 2 * components. kNoColumn: an array's.
    uint16_t column = 0;
};

struct ShaderInstance {
    ShaderInstanceKind kind = ShaderInstanceKind::Surface;
    uint32_t index = 0;             // among Scene::looks
    std::string name;               // the material's or light's
    std::vector<ShaderUse> layers;  // displacements, then surfaces; or one light
    uint32_t done_layers = 0;       // so many first ones have run on the mesh's vertices
    uint32_t node = kNone;          // scene node of "shader" space (lights; spatial parameters)
    std::vector<VaryingParam> varying;
    uint16_t column_count = kColVarying;
    rsl::LoweredShader lowered;  // the full kernel's (module moved out)
    SceneKernel full;
    std::optional<SceneKernel> opacity;  // for shadow rays, unless opaque
    std::vector<std::string> spaces;     // names of frame-rate spaces the kernels read
    bool hide_backfaces = false;
    uint32_t volume = 0;    // an interior's or exterior's number: runtime/scene/medium.h
    bool exterior = false;  // that volume surrounds its object
    bool area_light = false;
    // The light definitions that light it; nothing: all do.
    std::optional<std::vector<uint32_t>> lights;
    std::vector<int> aovs;  // of each plane of the film: the full kernel's output, -1 if none

    bool opaque() const { return lowered.opacity == rsl::LoweredShader::Opacity::Opaque; }
    const rsl::Shader& shader() const { return *layers.back().shader; }
    // Whose "shader" space it has, where that is no surface's of its own.
    SpaceOwner space_owner() const {
        return {node, kind == ShaderInstanceKind::Light && !area_light};
    }
    // Runs the frame kernels. Allocates nothing but in the first frame.
    void update(const FrameContext& context, InstanceFrame& frame) const;
    // The same for a kernel of vertices: "current" is the space of `object`, a scene node.
    void update_for_vertices(const FrameContext& context, uint32_t object,
                             InstanceFrame& frame) const;
};

// Where a parameter's frame-rate number comes from; `space` of a Spatial one is not set.
FrameInput parameter_input(const ShaderInstance& look, const rsl::KernelKey& key);

// A point-like parameter, given in shader space, in current space.
dvec3 parameter_in_current(rsl::BaseType type, const dmat4& current_from_shader,
                           const double* value);

}  // namespace kinora
