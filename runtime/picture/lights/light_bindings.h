// runtime/picture/lights/light_bindings.h: the outputs and parameters of lights, resolved once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rsl/model/renderer_services.h"
#include "runtime/picture/lights/reach.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

struct SceneLights;
struct SceneNodes;
struct SceneResources;
struct SceneShaders;

// Output columns of one illuminate or solar statement (-1: the kernel has none).
struct LightOutputs {
    rsl::LightKind kind = rsl::kLightAmbient;
    bool casts_shadow = false;
    int L[3], Cl[3], Ol[3], lit = -1;
    int spread = -1;                          // of solar with an angle: light comes from a cone
    int lamp = -1;                            // which light it is, where points have several
    bool sampled = false;                     // the light has sample methods, and no such columns
    int end[3] = {-1, -1, -1}, density = -1;  // of such a sample: where its shadow ray ends
};

// A number of a light that may be animated: in Pose::values, or fixed (`value` is kNone).
struct LightNumber {
    uint32_t value = kNone;
    float fixed = 0;
    float in(const Pose& pose) const;
};

// What one surface look reads of one light.
struct LightBinding {
    int32_t light = 0;  // its number among Scene::lights
    int32_t categories = 0;
    bool seen = true;  // some loop of the look asks for it
    LightNumber nondiffuse, nonspecular;
    std::vector<int> messages;   // output columns
    std::vector<int32_t> known;  // per message: the light has that parameter
};

class LightBindings {
  public:
    LightBindings(const SceneResources& resources, const SceneLights& lights,
                  const SceneShaders& shaders);
    // Of light `light` among Scene::lights, in the order of its source.
    std::span<const LightOutputs> statements(size_t light) const { return statements_[light]; }
    // What look `look` among Scene::looks, no light's, reads of it.
    const LightBinding& binding(size_t look, size_t light) const { return bindings_[look][light]; }
    // Where a light can send light in a pose, in current space; of other shaders than the library's
    // that is everywhere.
    static LightReach reach(const SceneNodes& scene, const Pose& pose, const ShaderInstance& look);
    // Whether some loop of some look asks for it.
    bool asked(size_t light) const { return asked_[light]; }
    // Whether some statement sends light from somewhere.
    bool directed(size_t light) const;

  private:
    std::vector<std::vector<LightOutputs>> statements_;  // [light]
    std::vector<std::vector<LightBinding>> bindings_;    // [look][light]
    std::vector<bool> asked_;                            // [light]
};

}  // namespace kinora
