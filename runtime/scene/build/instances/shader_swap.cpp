// runtime/scene/build/instances/shader_swap.cpp: two descriptions compared, and what differs
// compiled.
#include "runtime/scene/build/instances/shader_swap.h"

#include <algorithm>

#include "runtime/scene/build/instances/compile_instance.h"
#include "runtime/scene/build/instances/output_planes.h"
#include "runtime/scene/description/displacements.h"

namespace kinora {

namespace {

// A description beside the number of its values that every description of the scene shares.
struct Edited {
    const SceneDescription& description;
    size_t shared_values;

    bool owns(ValueSlot slot) const { return slot.present() && slot.offset >= shared_values; }
    std::span<const double> numbers(ValueSlot slot) const {
        return std::span(description.values).subspan(slot.offset, slot.count);
    }
};

bool same_value(const Edited& a, ValueSlot p, const Edited& b, ValueSlot q) {
    if (!a.owns(p) || !b.owns(q)) return p.offset == q.offset && p.count == q.count;
    return std::ranges::equal(a.numbers(p), b.numbers(q));
}

bool same_source(const Edited& a, const ParamSource& p, const Edited& b, const ParamSource& q) {
    return p.name == q.name && p.strings == q.strings && p.texcoord == q.texcoord &&
           p.by_columns == q.by_columns && same_value(a, p.value, b, q.value);
}

bool same_link(const LayerLink& p, const LayerLink& q) {
    return p.param == q.param && p.below == q.below && p.variable == q.variable;
}

bool same_use(const Edited& a, const ShaderUse& p, const Edited& b, const ShaderUse& q) {
    return p.shader == q.shader && p.space == q.space && p.linear_inputs == q.linear_inputs &&
           p.untinted == q.untinted && std::ranges::equal(p.links, q.links, same_link) &&
           std::ranges::equal(p.params, q.params, [&](const auto& one, const auto& other) {
               return same_source(a, one, b, other);
           });
}

// All shaders but those of materials' surfaces.
std::vector<const ShaderUse*> other_uses(const SceneDescription& description) {
    std::vector<const ShaderUse*> uses;
    for_each_shader_use(description, [&](const ShaderUse& use) { uses.push_back(&use); });
    for (const MaterialDefinition& material : description.materials)
        for (const ShaderUse& use : material.surfaces) std::erase(uses, &use);
    for (const LightDefinition& light : description.default_lights) uses.push_back(&light.shader);
    return uses;
}

bool same_node(const NodeDefinition& a, const NodeDefinition& b) {
    auto same_bind = [](const MaterialUse& p, const MaterialUse& q) {
        return p.material == q.material && p.params.size() == q.params.size();
    };
    auto same_mesh = [&](const MeshUse& p, const MeshUse& q) {
        return std::ranges::equal(p.materials, q.materials, same_bind);
    };
    return a.hidden == b.hidden && a.chosen == b.chosen &&
           std::ranges::equal(a.meshes, b.meshes, same_mesh);
}

bool same_besides_surfaces(const Edited& a, const Edited& b) {
    return std::ranges::equal(other_uses(a.description), other_uses(b.description),
                              [&](auto* p, auto* q) { return same_use(a, *p, b, *q); }) &&
           std::ranges::equal(a.description.nodes, b.description.nodes, same_node) &&
           std::ranges::equal(a.description.materials, b.description.materials, {},
                              &MaterialDefinition::atmosphere, &MaterialDefinition::atmosphere);
}

bool reads_Cs(const rsl::Shader& shader) {
    return std::ranges::any_of(shader.globals_read, [](const rsl::GlobalInfo* global) {
        return std::string_view(global->name) == "Cs";
    });
}

// The mesh gives both the same inputs, and the film takes the same outputs of both.
bool same_interface(const ShaderUse& a, const ShaderUse& b) {
    auto same = [](const rsl::ShaderParameter& p, const rsl::ShaderParameter& q) {
        return p.name == q.name && p.type == q.type && p.detail == q.detail && p.output == q.output;
    };
    auto is_map = [](const ParamSource& s) { return s.name.ends_with("_map"); };
    auto maps = [&](const ShaderUse& use) {
        std::vector<std::pair<std::string, std::string>> names;
        for (const ParamSource& source : use.params)
            if (is_map(source)) names.emplace_back(source.name, source.texcoord);
        return names;
    };
    return a.shader->kind == b.shader->kind && a.linear_inputs == b.linear_inputs &&
           a.untinted == b.untinted &&
           std::ranges::equal(a.shader->parameters, b.shader->parameters, same) &&
           reads_Cs(*a.shader) == reads_Cs(*b.shader) && maps(a) == maps(b);
}

const ParamSource* find_param(const ShaderUse& use, const std::string& name) {
    auto found = std::ranges::find(use.params, name, &ParamSource::name);
    return found == use.params.end() ? nullptr : &*found;
}

bool is_place(const rsl::Shader& shader, const ParamSource& source) {
    return source.value.count >= 3 &&
           std::ranges::any_of(shader.parameters, [&](const rsl::ShaderParameter& p) {
               return p.name == source.name && rsl::is_spatial(p.type.base);
           });
}

bool same_bindings(const std::vector<rsl::Layer>& a, const std::vector<rsl::Layer>& b) {
    auto same_param = [](const rsl::ParamBinding& p, const rsl::ParamBinding& q) {
        return p.name == q.name && p.kind == q.kind && p.constant == q.constant &&
               p.strings == q.strings && p.plain == q.plain && p.below == q.below &&
               p.variable == q.variable;
    };
    return std::ranges::equal(a, b, [&](const rsl::Layer& p, const rsl::Layer& q) {
        return p.shader == q.shader && std::ranges::equal(p.params, q.params, same_param);
    });
}

bool same_slots(const ShaderInstance& a, const ShaderInstance& b) {
    auto same_slot = [](const ParamSource& p, const ParamSource& q) {
        return p.name == q.name && p.value.offset == q.value.offset &&
               p.value.count == q.value.count;
    };
    return std::ranges::equal(a.layers, b.layers, [&](const ShaderUse& p, const ShaderUse& q) {
        return std::ranges::equal(p.params, q.params, same_slot);
    });
}

std::unique_ptr<ShaderInstance> without_kernels(const ShaderInstance& from) {
    auto bare = std::make_unique<ShaderInstance>();
    bare->kind = from.kind;
    bare->index = from.index;
    bare->name = from.name;
    bare->layers = from.layers;
    bare->done_layers = from.done_layers;
    bare->node = from.node;
    bare->varying = from.varying;
    bare->hide_backfaces = from.hide_backfaces;
    bare->area_light = from.area_light;
    return bare;
}

void add_new_names(std::vector<std::string>& to, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (std::ranges::find(to, name) == to.end()) to.push_back(name);
}

bool holds_all(const std::vector<std::string>& known, const std::vector<std::string>& names) {
    return std::ranges::all_of(names, [&](const std::string& name) {
        return std::ranges::find(known, name) != known.end();
    });
}

}  // namespace

struct ShaderSwapper::Draft {
    SceneDescription numbers;
    std::vector<Known> changed;  // without kernels
    ShaderSwap swap;

    void write(uint32_t offset, std::span<const double> values) {
        if (numbers.values.size() < offset + values.size())
            numbers.values.resize(offset + values.size());
        std::ranges::copy(values, numbers.values.begin() + offset);
        swap.numbers.push_back({offset, {values.begin(), values.end()}});
    }
};

ShaderSwapper::ShaderSwapper(const Scene& scene, SceneDescription description,
                             size_t values_as_read)
    : instances_(scene.shader_instances.size()),
      last_(std::move(description)),
      values_as_read_(values_as_read),
      outputs_(scene.outputs) {
    numbers_.values = scene.description->values;
    numbers_.animated = scene.description->animated;
    numbers_.animated.resize(numbers_.values.size(), false);
    options_.quality = scene.options.quality;
    options_.target = scene.options.target;
    options_.own_lines = true;  // who edits may look at the code beside the text
    for (const OutputPlane& plane : outputs_)
        if (!plane.parameter.empty()) add_new_names(options_.aovs, {plane.parameter});
    for (const NodeDefinition& node : scene.description->nodes)
        if (!node.id.empty()) space_names_.push_back(node.id);
    for (const auto& instance : scene.shader_instances) {
        if (instance->kind != ShaderInstanceKind::Light)
            add_new_names(light_messages_, instance->lowered.light_messages);
        for (const ShaderUse& layer : instance->layers)
            add_new_names(options_.gathered, rsl::gathered_parameters(*layer.shader));
    }
    for (const Surface& surface : scene.surfaces) {
        if (surface.look == kNone || surface.material == kNone) continue;
        Known& known = instances_[surface.look];
        if (known.instance) continue;
        known.instance = without_kernels(*scene.shader_instances[surface.look]);
        known.instance->index = surface.look;
        known.material = surface.material;
        known.opaque = scene.shader_instances[surface.look]->opaque();
    }
}

ShaderSwapper::Outcome ShaderSwapper::compile(ShaderInstance& instance, const Draft& draft,
                                              Diagnostics& diagnostics) const {
    for (const ShaderUse& layer : instance.layers)
        if (!holds_all(options_.gathered, rsl::gathered_parameters(*layer.shader)))
            return Outcome::Build;
    ShaderInstanceOptions options = options_;
    options.spaces = &space_names_;
    if (!compile_instance(instance, draft.numbers, options, diagnostics)) return Outcome::Failed;
    if (!holds_all(light_messages_, instance.lowered.light_messages)) return Outcome::Build;
    if (instance.opaque() != instances_[instance.index].opaque) return Outcome::Build;
    bind_planes(outputs_, instance);
    return Outcome::Swapped;
}

// What an instance binds over its material's parameters stays, unless it is them that changed.
ShaderSwapper::Outcome ShaderSwapper::change_instance(size_t index, const SceneDescription& edited,
                                                      Draft& draft,
                                                      Diagnostics& diagnostics) const {
    const Known& known = instances_[index];
    const Edited before{last_, values_as_read_}, after{edited, values_as_read_};
    const auto& old_uses = last_.materials[known.material].surfaces;
    const auto& new_uses = edited.materials[known.material].surfaces;
    auto next = without_kernels(*known.instance);
    if (next->layers.size() != new_uses.size()) return Outcome::Build;
    for (size_t l = 0; l < new_uses.size(); ++l) {
        if (!same_interface(old_uses[l], new_uses[l])) return Outcome::Build;
        const ShaderUse& had = known.instance->layers[l];
        ShaderUse& layer = next->layers[l];
        layer = new_uses[l];
        for (ParamSource& source : layer.params) {
            const ParamSource* old = find_param(old_uses[l], source.name);
            const ParamSource* own = find_param(had, source.name);
            if (old && own && same_source(before, *old, after, source)) {
                source = *own;
                continue;
            }
            if (is_place(*layer.shader, source) && next->node == kNone) return Outcome::Build;
            if (!after.owns(source.value)) continue;
            std::span<const double> numbers = after.numbers(source.value);
            bool in_place = own && before.owns(own->value) && own->value.count == numbers.size();
            source.value.offset =
                in_place ? own->value.offset : uint32_t(draft.numbers.values.size());
            draft.write(source.value.offset, numbers);
        }
        for (const ParamSource& own : had.params)
            if (!find_param(layer, own.name) && !find_param(old_uses[l], own.name))
                layer.params.push_back(own);
    }
    draft.numbers.animated.resize(draft.numbers.values.size(), false);
    draft.changed.push_back({without_kernels(*next), known.material, known.opaque});
    if (same_slots(*known.instance, *next) &&
        same_bindings(bound_layers(*known.instance, numbers_), bound_layers(*next, draft.numbers)))
        return Outcome::Swapped;
    Outcome outcome = compile(*next, draft, diagnostics);
    draft.swap.instances.push_back(std::move(next));
    return outcome;
}

ShaderSwapper::Outcome ShaderSwapper::swap(const SceneDescription& edited, Diagnostics& diagnostics,
                                           ShaderSwap& result) {
    const Edited before{last_, values_as_read_}, after{edited, values_as_read_};
    if (!same_besides_surfaces(before, after)) return Outcome::Build;
    Draft draft;
    draft.numbers = numbers_;
    for (uint32_t m = 0; m < edited.materials.size(); ++m) {
        const MaterialDefinition &was = last_.materials[m], &is = edited.materials[m];
        auto same = [&](const ShaderUse& p, const ShaderUse& q) {
            return same_use(before, p, after, q);
        };
        if (std::ranges::equal(was.surfaces, is.surfaces, same)) continue;
        bool plain =
            !displaces(was) && !displaces(is) && is.transformations.empty() && is.lights.empty();
        if (!plain || was.surfaces.size() != is.surfaces.size()) return Outcome::Build;
        for (size_t k = 0; k < instances_.size(); ++k) {
            if (instances_[k].material != m) continue;
            Outcome outcome = change_instance(k, edited, draft, diagnostics);
            if (outcome != Outcome::Swapped) return outcome;
        }
    }
    for (Known& known : draft.changed) {
        const uint32_t index = known.instance->index;
        instances_[index] = std::move(known);
    }
    numbers_ = std::move(draft.numbers);
    last_ = edited;
    result = std::move(draft.swap);
    return Outcome::Swapped;
}

std::unique_ptr<Scene> scene_beside(const Scene& scene) {
    const SceneParts& parts = scene;
    auto made = std::make_unique<Scene>(parts);
    const Pose& from = scene.start;
    Pose& start = made->start;
    start.camera = from.camera;
    start.time = from.time;
    start.shutter = from.shutter;
    start.values = from.values;
    start.changed = from.changed;
    start.nodes = from.nodes;
    start.view = from.view;
    return made;
}

std::unique_ptr<Scene> swapped_scene(const Scene& scene, ShaderSwap swap) {
    std::unique_ptr<Scene> made = scene_beside(scene);
    std::vector<double>& values = made->start.values;
    for (const ShaderSwap::Numbers& numbers : swap.numbers) {
        const size_t end = numbers.offset + numbers.values.size();
        if (values.size() < end) values.resize(end);
        std::ranges::copy(numbers.values, values.begin() + numbers.offset);
    }
    for (auto& instance : swap.instances)
        made->shader_instances[instance->index] = std::move(instance);
    return made;
}

bool same_besides_swaps(const Scene& a, const Scene& b) {
    return a.nodes.data() == b.nodes.data();
}

void take_swaps(const Scene& before, const Scene& now, Pose& pose) {
    const std::vector<double>&was = before.start.values, &is = now.start.values;
    pose.values.resize(is.size());
    // No channel writes a value that an edit gives.
    for (size_t k = 0; k < is.size(); ++k)
        if (k >= was.size() || is[k] != was[k]) pose.values[k] = is[k];
    pose.shading.reset();
}

}  // namespace kinora
