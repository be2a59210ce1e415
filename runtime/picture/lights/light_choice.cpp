// runtime/picture/lights/light_choice.cpp: from lights to groups of lamps.
#include "runtime/picture/lights/light_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "runtime/scene/lights.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shaders.h"

namespace kinora {

namespace {

// What `auto` means: so many of more lights than these. Below, all take less time.
constexpr size_t kUsualCount = 8, kUsualLeast = 16;

// One statement from one place, by a kernel that calls nothing and draws nothing.
bool may_be_chosen(const LightSource& source, const ShaderInstance& look,
                   std::span<const LightOutputs> statements) {
    if (source.surface != kNone || statements.size() != 1) return false;
    const LightOutputs& statement = statements[0];
    const bool sends = statement.L[0] >= 0 && statement.L[1] >= 0 && statement.L[2] >= 0;
    return statement.kind == rsl::kLightIlluminate && sends && !statement.sampled &&
           statement.spread < 0 && look.full.services.empty() && look.lowered.gathers.empty() &&
           !look.lowered.draws_random && !look.lowered.uses_rng;
}

// What reads the records of lights.
std::vector<size_t> reading_looks(const SceneShaders& shaders) {
    std::vector<size_t> looks;
    for (const auto& look : shaders.shader_instances)
        if (look->kind != ShaderInstanceKind::Light) looks.push_back(look->index);
    return looks;
}

// All that records say of a light to each look, but for numbers of a pose.
std::vector<int32_t> said_of(size_t light, const LightOutputs& statement,
                             std::span<const size_t> looks, const LightBindings& bindings) {
    std::vector<int32_t> said{int32_t(statement.casts_shadow)};
    for (size_t look : looks) {
        const LightBinding& binding = bindings.binding(look, light);
        said.push_back(int32_t(binding.seen));
        said.push_back(binding.categories);
        said.insert(said.end(), binding.known.begin(), binding.known.end());
    }
    return said;
}

}  // namespace

LightChoice::LightChoice(const SceneLights& lights, const SceneShaders& shaders,
                         const LightBindings& bindings)
    : lights_(lights), shaders_(shaders), held_(lights.lights.size()) {
    const std::vector<size_t> looks = reading_looks(shaders);
    std::map<std::vector<int32_t>, uint32_t> kinds;
    for (uint32_t l = 0; l < lights.lights.size() && !looks.empty(); ++l) {
        const LightSource& source = lights.lights[l];
        const auto statements = bindings.statements(l);
        if (!bindings.asked(l) ||
            !may_be_chosen(source, *shaders.shader_instances[source.look], statements))
            continue;
        const auto said = said_of(l, statements[0], looks, bindings);
        const uint32_t kind = kinds.try_emplace(said, uint32_t(kinds.size())).first->second;
        const LightBinding& binding = bindings.binding(looks[0], l);
        candidates_.push_back({l, kind, binding.nondiffuse, binding.nonspecular});
    }
}

bool LightChoice::Standing::alike(const Standing& other) const {
    return kind == other.kind && nondiffuse == other.nondiffuse && nonspecular == other.nonspecular;
}

// Both are in the order of the lights.
void LightChoice::find_standing(const SceneNodes& nodes, const Pose& pose,
                                std::span<const size_t> present) {
    standing_.clear();
    auto next = present.begin();
    for (const Candidate& candidate : candidates_) {
        next = std::lower_bound(next, present.end(), candidate.light);
        if (next == present.end() || *next != candidate.light) continue;
        const LightSource& source = lights_.lights[candidate.light];
        const auto lamp = lamp_of(nodes, pose, *shaders_.shader_instances[source.look]);
        if (!lamp || lamp->strength == 0) continue;
        const float nondiffuse = candidate.nondiffuse.in(pose),
                    nonspecular = candidate.nonspecular.in(pose);
        if (std::isnan(nondiffuse) || std::isnan(nonspecular)) continue;
        standing_.push_back({candidate.light, candidate.kind, nondiffuse, nonspecular, *lamp});
    }
    std::ranges::sort(standing_, {}, [](const Standing& s) {
        return std::tuple(s.kind, s.nondiffuse, s.nonspecular, s.light);
    });
}

void LightChoice::begin_frame(const SceneNodes& nodes, const Pose& pose,
                              std::span<const size_t> present, ChosenLights wanted) {
    const bool usual = wanted == ChosenLights::Auto;
    const size_t number =
        wanted < ChosenLights::One ? 0 : size_t(1) << (size_t(wanted) - size_t(ChosenLights::One));
    count_ = usual ? kUsualCount : number;
    least_ = usual ? kUsualLeast : number;
    if (count_ == 0 || candidates_.size() <= least_) return;
    find_standing(nodes, pose, present);
    if (standing_ == before_) return;
    make_groups();
    std::swap(standing_, before_);
}

void LightChoice::make_groups() {
    group_count_ = 0;
    std::fill(held_.begin(), held_.end(), false);
    for (size_t begin = 0, end; begin < standing_.size(); begin = end) {
        for (end = begin; end < standing_.size() && standing_[end].alike(standing_[begin]);) ++end;
        if (end - begin > least_) add_group({standing_.data() + begin, end - begin});
    }
}

void LightChoice::add_group(std::span<const Standing> lamps) {
    if (groups_.size() == group_count_) groups_.emplace_back();
    LampGroup& group = groups_[group_count_++];
    group.lights.clear();
    lamps_.clear();
    for (const Standing& standing : lamps) {
        group.lights.push_back(standing.light);
        lamps_.push_back(standing.lamp);
        held_[standing.light] = true;
    }
    group.tree.build(lamps_);
}

}  // namespace kinora
