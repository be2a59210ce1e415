// runtime/build/looks.cpp: cameras, lights and looks of a scene under construction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/build/scene_p.h"
#include "runtime/description/findings.h"
#include "runtime/description/shader_library.h"
#include "runtime/scene/transforms.h"

namespace kinora {

// What was added has values too.
void SceneBuilder::extend_values() {
    description_.animated.resize(description_.values.size(), false);
    size_t known = scene_->values.size();
    scene_->values.insert(scene_->values.end(), description_.values.begin() + ptrdiff_t(known),
                          description_.values.end());
}

// A node that no file wrote.
uint32_t SceneBuilder::add_node(NodeDefinition definition, uint32_t parent) {
    Scene& scene = *scene_;
    extend_values();
    uint32_t index = uint32_t(description_.nodes.size());
    // Node bits come first among the owners: those behind move up by one word-safe step.
    description_.nodes.push_back(std::move(definition));
    definition_moves_.push_back(false);
    for (anim::Channel& channel : description_.animation.channels)
        if (channel.owner >= index) ++channel.owner;
    ++description_.animation.owner_count;
    unroll(index, parent, dmat4(1.0));
    evaluate(scene.options.start_time);
    return uint32_t(scene.nodes.size() - 1);
}

// The node of the file that a node stands below.
uint32_t SceneBuilder::named_node(uint32_t n) const {
    while (description_.nodes[scene_->nodes[n].definition].reference) n = scene_->nodes[n].parent;
    return n;
}

void SceneBuilder::place_cameras() {
    Scene& scene = *scene_;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const NodeDefinition& node = description_.nodes[scene.nodes[n].definition];
        const std::string& id = description_.nodes[scene.nodes[named_node(n)].definition].id;
        for (uint32_t camera : node.cameras)
            scene.cameras.push_back({camera, n, id.empty() ? description_.cameras[camera].id : id});
    }
    if (!scene.cameras.empty()) return;
    DefaultCamera added =
        default_camera(played_bounds(), description_.up_axis, description_.values);
    description_.cameras.push_back(added.camera);
    uint32_t node = add_node(std::move(added.node), kNone);
    scene.cameras.push_back({uint32_t(description_.cameras.size() - 1), node, "default camera"});
    scene.added.push_back("default camera");
}

bool SceneBuilder::choose_camera() {
    Scene& scene = *scene_;
    const std::string& wanted = scene.options.camera;
    if (wanted.empty()) {
        auto below = [&](uint32_t n) {
            while (n != kNone && scene.nodes[n].definition != description_.camera_node)
                n = scene.nodes[n].parent;
            return n != kNone;
        };
        for (uint32_t c = 0; description_.camera_node != kNone && c < scene.cameras.size(); ++c)
            if (below(scene.cameras[c].node)) {
                scene.camera = c;
                break;
            }
        return true;
    }
    for (int pass = 0; pass < 2; ++pass)  // node path or id first, then camera id
        for (uint32_t c = 0; c < scene.cameras.size(); ++c) {
            const CameraDefinition& camera = description_.cameras[scene.cameras[c].definition];
            uint32_t named = named_node(scene.cameras[c].node);
            const NodeDefinition& node = description_.nodes[scene.nodes[named].definition];
            std::string path;
            for (uint32_t n = named; n != kNone; n = scene.nodes[n].parent) {
                const NodeDefinition& step = description_.nodes[scene.nodes[n].definition];
                path = (step.id.empty() ? step.name : step.id) + (path.empty() ? "" : "/" + path);
            }
            bool match = pass == 0 ? wanted == path || wanted == node.id || wanted == node.name
                                   : wanted == camera.id || wanted == camera.name;
            if (!match) continue;
            scene.camera = c;
            return true;
        }
    diagnostics_.report(Code::CAMERA_UNKNOWN, Location{}, wanted);
    return false;
}

void SceneBuilder::add_light(LightDefinition definition, uint32_t node) {
    extend_values();
    description_.lights.push_back(std::move(definition));
    scene_->lights.push_back({uint32_t(description_.lights.size() - 1), node, kNone, kNone});
    scene_->added.push_back(description_.lights.back().name);
}

void SceneBuilder::place_lights() {
    Scene& scene = *scene_;
    LightSet wanted = scene.options.lights;
    bool lit = wanted != LightSet::Default && add_area_lights(), ambient = false;
    for (uint32_t n = 0; wanted != LightSet::Default && n < scene.nodes.size(); ++n)
        for (uint32_t light : description_.nodes[scene.nodes[n].definition].lights) {
            if (scene.nodes[n].hidden) continue;
            scene.lights.push_back({light, n, kNone, kNone});
            (description_.lights[light].ambient ? ambient : lit) = true;
        }
    if (wanted == LightSet::Scene) return;
    if (wanted == LightSet::Auto && (lit || needs_no_light())) return;
    // Before add_node, which takes the description's values over into the scene.
    LightDefinition air = default_ambient_light(description_.values, diagnostics_);
    uint32_t node =
        add_node(default_light_node(description_.values), scene.cameras[scene.camera].node);
    add_light(default_distant_light(diagnostics_), node);
    if (!ambient) add_light(std::move(air), node);
}

// Where every surface is constant.
bool SceneBuilder::needs_no_light() const {
    const Scene& scene = *scene_;
    bool all_constant = !scene.surfaces.empty();
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Shape& shape = scene.shapes[scene.surfaces[s].shape];
        const std::string& symbol = scene.meshes[shape.mesh].groups[scene.surfaces[s].group].symbol;
        bool constant = false;
        for (const MaterialUse& use : uses_[s]->materials)
            if (use.symbol == symbol && use.material != kNone) {
                const auto& surfaces = description_.materials[use.material].surfaces;
                constant =
                    surfaces.size() == 1 && (surfaces[0].shader->name == "collada_constant" ||
                                             surfaces[0].shader->name == "gltf_unlit");
            }
        all_constant &= constant;
    }
    return all_constant;
}

// ---- looks
// ---------------------------------------------------------------------------------------

const MaterialDefinition& SceneBuilder::default_material() {
    if (default_material_.surfaces.empty()) {
        default_material_.name = "default";
        ShaderUse use;
        use.shader = description_.default_surface ? description_.default_surface
                                                  : library_shader("default_surface", diagnostics_);
        default_material_.surfaces.push_back(std::move(use));
    }
    return default_material_;
}

namespace {

const VertexAttribute* find_attribute(const PrimitiveGroup& group, std::string_view semantic,
                                      uint32_t set) {
    const VertexAttribute* best = nullptr;
    for (const VertexAttribute& a : group.attributes) {
        if (a.semantic != semantic) continue;
        if (set == kNone ? !best || a.set < best->set : a.set == set) best = &a;
    }
    return best;
}

const VertexBinding* find_binding(const MaterialUse* use, std::string_view param) {
    if (use)
        for (const VertexBinding& binding : use->vertex_bindings)
            if (binding.param == param) return &binding;
    return nullptr;
}

bool has_placed_param(const ShaderUse& use) {
    for (const ParamSource& source : use.params)
        for (const rsl::ShaderParameter& p : use.shader->parameters)
            if (source.name == p.name && rsl::is_spatial(p.type.base) && source.value.count >= 3)
                return true;
    return false;
}

}  // namespace

// Texture coordinates and varying parameters of one surface; the look's list of varying parameters
// must be the same for all surfaces that share it, so it is part of the look's key.
bool SceneBuilder::bind_vertex_inputs(Surface& surface, const MaterialUse* use,
                                      ShaderInstance& look,
                                      std::vector<const VertexAttribute*>& inputs) {
    Scene& scene = *scene_;
    const Mesh& mesh = scene.meshes[scene.shapes[surface.shape].mesh];
    const PrimitiveGroup& group = *mesh.groups[surface.group].definition;
    surface.st = find_attribute(group, "TEXCOORD", kNone);
    // A file's texcoord names bind sets; the first one is s and t.
    std::string first_texcoord;
    auto st_of = [&](const std::string& name) {
        const VertexBinding* binding = find_binding(use, name);
        const VertexAttribute* found =
            binding ? find_attribute(group, binding->semantic, binding->set) : nullptr;
        return found ? found : find_attribute(group, "TEXCOORD", kNone);
    };
    auto add = [&](uint32_t layer, std::string name, std::string semantic,
                   const VertexAttribute* attribute, uint32_t component, uint32_t components) {
        VaryingParam varying;
        varying.name = std::move(name);
        varying.semantic = std::move(semantic);
        varying.set = attribute ? attribute->set : kNone;
        varying.layer = layer;
        varying.components = components;
        varying.component = component;
        look.varying.push_back(std::move(varying));
        inputs.push_back(attribute);
    };
    for (uint32_t l = 0; l < look.layers.size(); ++l) {
        const ShaderUse& layer = look.layers[l];
        for (const ParamSource& source : layer.params) {
            if (source.strings.empty() || !source.name.ends_with("_map")) continue;
            const VertexAttribute* st = st_of(source.texcoord);
            if (first_texcoord.empty()) {
                first_texcoord = source.texcoord + "?";
                if (st) surface.st = st;
            } else if (st && st != surface.st) {
                std::string slot = source.name.substr(0, source.name.size() - 4);
                add(l, slot + "_s", "TEXCOORD", st, 0, 1);
                add(l, slot + "_t", "TEXCOORD", st, 1, 1);
            }
        }
        for (const rsl::GlobalInfo* global : layer.shader->globals_read) {
            if (std::string_view(global->name) != "Cs") continue;
            const VertexAttribute* color = find_attribute(group, "COLOR", kNone);
            if (color && color->stride >= 3) add(l, "Cs", "COLOR", color, 0, 3);
        }
        for (const rsl::ShaderParameter& p : layer.shader->parameters) {
            if (p.type.is_array() || p.type.base == rsl::BaseType::String) continue;
            uint32_t components = uint32_t(rsl::component_count(p.type.base));
            const VertexBinding* binding = find_binding(use, p.name);
            const VertexAttribute* attribute =
                binding ? find_attribute(group, binding->semantic, binding->set)
                        : find_attribute(group, p.name, kNone);
            if (attribute)
                add(l, std::string(p.name), attribute->semantic, attribute, 0, components);
            else if (p.name == "Pref" && components == 3)
                add(l, "Pref", "Pref", nullptr, 0, 3);
        }
    }
    return true;
}

static bool is_node_matrix(const SceneDescription& description, uint32_t value) {
    for (const NodeDefinition& node : description.nodes)
        for (const Transform& t : node.transforms)
            if (t.value == value) return t.kind == TransformKind::Matrix;
    return false;
}

void SceneBuilder::apply_binds(const MaterialUse* use, std::vector<ShaderUse>& layers,
                               std::string& key) {
    if (!use) return;
    for (const auto& [name, slot] : use->params) {
        key += fmt::format("|{}={}+{}", name, slot.offset, slot.count);
        bool matrix = slot.count == 16 && is_node_matrix(description_, slot.offset);
        for (ShaderUse& layer : layers) {
            std::erase_if(layer.params, [&](const ParamSource& s) { return s.name == name; });
            ParamSource source;
            source.name = name;
            source.value = slot;
            source.by_columns = matrix;
            layer.params.push_back(std::move(source));
        }
    }
}

uint32_t SceneBuilder::look_of(Surface& surface, const MeshUse& mesh_use) {
    Scene& scene = *scene_;
    const Shape& shape = scene.shapes[surface.shape];
    const std::string& symbol = scene.meshes[shape.mesh].groups[surface.group].symbol;
    const MaterialUse* use = nullptr;
    for (const MaterialUse& candidate : mesh_use.materials)
        if (candidate.symbol == symbol) use = &candidate;
    // A file that names materials directly by symbol means the material of that id.
    uint32_t material = use ? use->material : kNone;
    surface.material = material;
    const MaterialDefinition* definition =
        material != kNone ? &description_.materials[material] : &default_material();
    // A material that only displaces shows the default surface.
    const std::vector<ShaderUse>& surfaces =
        definition->surfaces.empty() ? default_material().surfaces : definition->surfaces;
    vertex_look(ShaderInstanceKind::Transformation, surface, use, *definition,
                surface.transformation);
    bool bump = scene.options.displacement == DisplacementMode::Bump;
    if (!bump)
        vertex_look(ShaderInstanceKind::Displacement, surface, use, *definition,
                    surface.displacement);
    std::vector<ShaderUse> layers = definition->displacements;
    bool bare = definition->surfaces.empty() && !definition->lights.empty();
    const std::vector<ShaderUse>& seen = bare ? emitter(*definition) : surfaces;
    layers.insert(layers.end(), seen.begin(), seen.end());
    std::string key;
    auto look =
        begin_look(ShaderInstanceKind::Surface, *definition, std::move(layers), use, shape, key);
    add_volumes(surface, *definition, use);
    if (surface.displacement.look != kNone)
        look->done_layers = uint32_t(definition->displacements.size());
    bind_vertex_inputs(surface, use, *look, surface.varying);
    if (look->done_layers) bind_displaced(surface, *look);
    for (const VaryingParam& v : look->varying)
        key += fmt::format("|{}:{}={}", v.layer, v.name, v.semantic == "Pref");
    auto [place, is_new] = looks_by_key_.try_emplace(key, uint32_t(scene.looks.size()));
    if (is_new) scene.looks.push_back(std::move(look));
    return place->second;
}

// A look of the material's shaders with the instance's <bind>s over them; `key` is the same for
// looks that are.
std::unique_ptr<ShaderInstance> SceneBuilder::begin_look(ShaderInstanceKind kind,
                                                         const MaterialDefinition& definition,
                                                         std::vector<ShaderUse> layers,
                                                         const MaterialUse* use, const Shape& shape,
                                                         std::string& key) {
    auto look = std::make_unique<ShaderInstance>();
    look->kind = kind;
    look->name = definition.id.empty() ? definition.name : definition.id;
    look->hide_backfaces = definition.hide_backfaces;
    look->layers = std::move(layers);
    key = fmt::format("{} {}", int(kind), static_cast<const void*>(&definition));
    apply_binds(use, look->layers, key);
    for (const ShaderUse& layer : look->layers)
        if (has_placed_param(layer)) look->node = shape.node;
    if (look->node != kNone) key += fmt::format("|node {}", look->node);
    return look;
}

// The look of a material's transformations, or of its displacements: nothing where it has none, or
// where they leave P alone (then N is bent while shading).
uint32_t SceneBuilder::vertex_look(ShaderInstanceKind kind, Surface& surface,
                                   const MaterialUse* use, const MaterialDefinition& definition,
                                   VertexUse& result) {
    Scene& scene = *scene_;
    bool displacement = kind == ShaderInstanceKind::Displacement;
    const auto& layers = displacement ? definition.displacements : definition.transformations;
    if (layers.empty()) return kNone;
    std::string key;
    auto look = begin_look(kind, definition, layers, use, scene.shapes[surface.shape], key);
    bind_vertex_inputs(surface, use, *look, result.varying);
    for (const VaryingParam& v : look->varying)
        key += fmt::format("|{}:{}={}", v.layer, v.name, v.semantic == "Pref");
    auto [place, is_new] = looks_by_key_.try_emplace(key, uint32_t(scene.vertex_looks.size()));
    if (is_new) {
        look->index = place->second;
        bool compiled = compile(*look, {});
        vertex_looks_ok_ &= compiled;
        // A displacement that failed stays here too: its errors have been told.
        if (compiled && displacement && !look->lowered.moves_P)
            place->second = kNone;
        else
            scene.vertex_looks.push_back(std::move(look));
    }
    return result.look = place->second;
}

// What displacements that are done left in their output parameters, for displacement("name").
void SceneBuilder::bind_displaced(Surface& surface, ShaderInstance& look) {
    for (uint32_t l = 0; l < look.done_layers; ++l)
        for (const rsl::ShaderParameter& p : look.layers[l].shader->parameters) {
            if (!p.output) continue;
            for (size_t k = look.varying.size(); k-- > 0;)
                if (look.varying[k].layer == l && look.varying[k].name == p.name) {
                    look.varying.erase(look.varying.begin() + ptrdiff_t(k));
                    surface.varying.erase(surface.varying.begin() + ptrdiff_t(k));
                }
            VaryingParam varying;
            varying.name = std::string(p.name);
            varying.semantic = "vertex:" + varying.name;
            varying.layer = l;
            varying.text = p.type.base == rsl::BaseType::String;
            varying.array = p.type.is_array();
            varying.components = uint32_t(rsl::component_count(p.type.base) *
                                          (varying.array ? p.type.array_length : 1));
            look.varying.push_back(std::move(varying));
            surface.varying.push_back(nullptr);  // until the mesh is diced
        }
}

bool SceneBuilder::compile(ShaderInstance& look, const std::vector<std::string>& messages) {
    ShaderInstanceOptions options;
    options.math = scene_->options.math;
    options.target = scene_->options.target;
    options.light_messages = messages;
    if (look.kind == ShaderInstanceKind::Surface) options.aovs = output_names_;
    options.spaces = &space_names_;
    if (look.kind == ShaderInstanceKind::Surface) options.gathered = gathered_;
    if (scene_->options.want_dumps) options.dumps = &scene_->options.dumps;
    return compile_look(look, description_, options, diagnostics_);
}

// COLLADA's attenuation is by distance in units of the light's file.
void SceneBuilder::set_unit(const LightSource& light, ShaderUse& use) {
    double unit = unit_of(path_conversion(*scene_, light.node));
    if (unit == 1 || !use.shader->name.starts_with("collada_")) return;
    ParamSource source;
    source.name = "unit";
    source.value = {uint32_t(description_.values.size()), 1};
    description_.values.push_back(unit);
    extend_values();
    use.params.push_back(std::move(source));
}

bool SceneBuilder::make_looks() {
    Scene& scene = *scene_;
    for (const NodeDefinition& node : description_.nodes)
        if (!node.id.empty()) space_names_.push_back(node.id);
    for (size_t s = 0; s < scene.surfaces.size(); ++s)
        scene.surfaces[s].look = look_of(scene.surfaces[s], *uses_[s]);
    add_atmosphere();
    add_outputs();
    add_imager();
    bool ok = vertex_looks_ok_;
    for (const auto& look : scene.looks)
        for (const ShaderUse& layer : look->layers)
            for (const std::string& name : rsl::gathered_parameters(*layer.shader))
                if (std::find(gathered_.begin(), gathered_.end(), name) == gathered_.end())
                    gathered_.push_back(name);
    std::vector<std::string> messages;
    for (auto& look : scene.looks) {
        ok &= compile(*look, {});
        if (ok) bind_outputs(*look);
        for (const std::string& message : look->lowered.light_messages)
            if (std::find(messages.begin(), messages.end(), message) == messages.end())
                messages.push_back(message);
    }
    std::erase_if(scene.lights, [&](const LightSource& light) {
        return !description_.lights[light.definition].shader.shader;
    });
    for (LightSource& light : scene.lights) {
        const LightDefinition& definition = description_.lights[light.definition];
        auto look = std::make_unique<ShaderInstance>();
        look->kind = ShaderInstanceKind::Light;
        look->name = definition.id.empty() ? definition.name : definition.id;
        look->layers = {definition.shader};
        set_unit(light, look->layers.front());
        look->node = light.node;
        look->area_light = light.surface != kNone;
        ok &= compile(*look, messages);
        light.look = uint32_t(scene.looks.size());
        scene.looks.push_back(std::move(look));
    }
    return ok;
}

}  // namespace kinora
