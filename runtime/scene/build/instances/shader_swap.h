// runtime/scene/build/instances/shader_swap.h: a scene with other surface shaders and parameters,
// which shares the rest with the one before: only the kernels that this concerns are compiled.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/build/instances/compile_instance.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

// What a change of materials asks of the scene.
struct ShaderSwap {
    struct Numbers {
        uint32_t offset;  // into the scene's values, which become longer where need be
        std::vector<double> values;
    };
    std::vector<std::unique_ptr<ShaderInstance>> instances;  // compiled, by ShaderInstance::index
    std::vector<Numbers> numbers;
};

// Another scene that shares all with this one.
std::unique_ptr<Scene> scene_beside(const Scene& scene);

// The scene with what the swap changes, which is for it or for what the swaps before made of it.
// What is not changed is shared, so both may be rendered at once. The description stays that of the
// first scene.
std::unique_ptr<Scene> swapped_scene(const Scene& scene, ShaderSwap swap);

// Whether swaps have made one of the other, or both of the same scene.
bool same_besides_swaps(const Scene& a, const Scene& b);
// A pose of `before` becomes one of `now`, of which the same is true.
void take_swaps(const Scene& before, const Scene& now, Pose& pose);

// Makes swaps. After its constructor it does not look at the scene.
class ShaderSwapper {
  public:
    // A scene that has just been built. `description`: what it was built from; of its values the
    // first `values_as_read` are no edit's. Meshes and animation may be missing.
    ShaderSwapper(const Scene& scene, SceneDescription description, size_t values_as_read);

    enum class Outcome : uint8_t {
        Swapped,
        Failed,  // a shader cannot be compiled; findings say why
        Build    // more has changed than kernels and their numbers: the scene is to be built anew
    };
    // From the description of the last swap to this one.
    Outcome swap(const SceneDescription& edited, Diagnostics& diagnostics, ShaderSwap& result);

  private:
    struct Draft;  // of one swap
    Outcome change_instance(size_t index, const SceneDescription& edited, Draft& draft,
                            Diagnostics& diagnostics) const;
    Outcome compile(ShaderInstance& instance, const Draft& draft, Diagnostics& diagnostics) const;

    struct Known {
        std::unique_ptr<ShaderInstance> instance;  // without kernels; null: no material's surface
        uint32_t material = kNone;
        bool opaque = true;
    };
    std::vector<Known> instances_;  // by index
    SceneDescription last_;
    SceneDescription numbers_;  // the scene's values, and which are animated
    size_t values_as_read_;
    ShaderInstanceOptions options_;
    std::vector<std::string> space_names_, light_messages_;
    std::vector<OutputPlane> outputs_;
};

}  // namespace kinora
