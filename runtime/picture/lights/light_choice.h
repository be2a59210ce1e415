// runtime/picture/lights/light_choice.h: which lights of a scene are so many and so much alike that
// each point is lit by a few of them, and the trees by which these are chosen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/picture/lights/light_bindings.h"
#include "runtime/picture/lights/light_tree.h"
#include "runtime/scene/quality/quality.h"

namespace kinora {

// Lights whose records differ in nothing but what arrives: kind, categories, messages that are
// known, shadows, __nondiffuse and __nonspecular are the same to all surfaces.
struct LampGroup {
    std::vector<uint32_t> lights;  // of Scene::lights
    LightTree tree;                // of their lamps, by place in `lights`
};

class LightChoice {
  public:
    LightChoice(const SceneLights& lights, const SceneShaders& shaders,
                const LightBindings& bindings);
    // Makes the groups of a pose, of those `present` that are not black. Where its lamps are those
    // of the frame before, they stand.
    void begin_frame(const SceneNodes& nodes, const Pose& pose, std::span<const size_t> present,
                     ChosenLights wanted);

    // The most lights that are chosen of a group for a point.
    size_t count() const { return count_; }
    std::span<const LampGroup> groups() const { return {groups_.data(), group_count_}; }
    // Whether the light is in a group.
    bool holds(size_t light) const { return held_[light]; }
    // Whether surfaces of the look may be lit by lights that are chosen: their loops do not ask
    // which lights there are.
    bool serves(const ShaderInstance& look) const {
        return group_count_ > 0 && !look.lowered.tells_lights_apart;
    }

  private:
    // A light that may be chosen among those of its kind.
    struct Candidate {
        uint32_t light = 0, kind = 0;
        LightNumber nondiffuse, nonspecular;
    };
    // The same in a pose.
    struct Standing {
        uint32_t light = 0, kind = 0;
        float nondiffuse = 0, nonspecular = 0;
        Lamp lamp;
        bool operator==(const Standing&) const = default;
        bool alike(const Standing& other) const;
    };
    void find_standing(const SceneNodes& nodes, const Pose& pose, std::span<const size_t> present);
    void make_groups();
    void add_group(std::span<const Standing> lamps);

    const SceneLights& lights_;
    const SceneShaders& shaders_;
    std::vector<Candidate> candidates_;
    std::vector<Standing> standing_, before_;
    std::vector<Lamp> lamps_;  // of a group that is made
    std::vector<LampGroup> groups_;
    size_t group_count_ = 0, count_ = 0;
    size_t least_ = 0;  // lights of a group are more
    std::vector<bool> held_;
};

}  // namespace kinora
