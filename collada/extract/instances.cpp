// collada/extract/instances.cpp: meshes, lights and cameras that a node shows.
#include <algorithm>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

VertexInputBinding read_vertex_input(Extraction& x, Link link) {
    const Element& e = *link.element;
    VertexInputBinding binding{std::string(e.value("semantic")),
                               std::string(e.value("input_semantic")), kNone, x.where(link)};
    uint64_t set = 0;
    if (parse_count(e.value("input_set"), set) && set < kNone) binding.input_set = uint32_t(set);
    return binding;
}

void read_material_instance(Extraction& x, Link link, MeshInstance& mesh, uint32_t node_number,
                            uint32_t mesh_number) {
    const Element& e = *link.element;
    MaterialBinding material;
    material.symbol = e.value("symbol");
    material.where = x.where(link);
    if (Link target = resolve(x, link, "target", {"material"}))
        material.material = material_index(x, target);
    for (const Element& child : e.children()) {
        Link part{link.doc, &child};
        if (child.name == "bind_vertex_input") {
            material.vertex_inputs.push_back(read_vertex_input(x, part));
        } else if (child.name == "bind") {
            ParamBinding bind{std::string(child.value("semantic")),
                              std::string(child.value("target")),
                              {},
                              x.where(part, "target")};
            x.pending_bindings.push_back(
                {node_number, mesh_number, uint32_t(mesh.materials.size()), bind, link.doc});
        }
    }
    mesh.materials.push_back(std::move(material));
}

void read_bind_material(Extraction& x, Link instance, MeshInstance& mesh, uint32_t node_number,
                        uint32_t mesh_number) {
    const Element* bind = instance.element->child("bind_material");
    const Element* common = bind ? bind->child("technique_common") : nullptr;
    if (!common) return;
    for (const Element& child : common->children())
        if (child.name == "instance_material")
            read_material_instance(x, {instance.doc, &child}, mesh, node_number, mesh_number);
}

// <extra><technique profile="RSL"><lights><instance_light url="#lamp"/></lights> of a mesh, or of
// its node.
std::optional<std::vector<uint32_t>> read_light_list(Extraction& x, Link owner) {
    const Element* technique = extra_technique(*owner.element, "RSL");
    const Element* list = technique ? technique->child("lights") : nullptr;
    if (!list) return std::nullopt;
    std::vector<uint32_t> lights;
    for (const Element& child : list->children()) {
        if (child.name != "instance_light") continue;
        if (!x.budget.reserve(sizeof(uint32_t), x.where(owner))) break;
        Link target = resolve(x, {owner.doc, &child}, "url", {"light"});
        uint32_t light = target ? light_index(x, target) : kNone;
        if (light != kNone) lights.push_back(light);
    }
    std::ranges::sort(lights);
    lights.erase(std::unique(lights.begin(), lights.end()), lights.end());
    return lights;
}

// Sets the skin, morph and geometry of a <controller>; false if it shows nothing. A morph that is
// left out (reported) gives way to the controller it is written on, at most `depth` below.
bool read_controller(Extraction& x, Link controller, MeshInstance& mesh, int depth = 4) {
    if (controller.element->child("skin")) {
        mesh.skin = skin_index(x, controller);
        if (mesh.skin == kNone) return false;
        const Skin& skin = x.scene.skins[mesh.skin];
        mesh.geometry = skin.geometry;
        mesh.morph = skin.morph;
        if (skin.joints.empty()) mesh.skin = kNone;  // broken, reported: the mesh as it is
        return true;
    }
    if (const Element* morph = controller.element->child("morph")) {
        mesh.morph = morph_index(x, controller);
        if (mesh.morph == kNone) {
            std::string_view source = morph->value("source");
            if (depth == 0 || !source.starts_with('#')) return false;
            const Document& document = x.document(controller.doc);
            const Element* base = find_kind(document, source.substr(1), {"controller"});
            return base && read_controller(x, {controller.doc, base}, mesh, depth - 1);
        }
        const Morph& read = x.scene.morphs[mesh.morph];
        mesh.geometry = read.geometry;
        if (read.skin != kNone && !x.scene.skins[read.skin].joints.empty()) mesh.skin = read.skin;
        return true;
    }
    x.diag.report(Code::SCHEMA_MISSING_ELEMENT, x.where(controller), "controller",
                  "skin> or <morph");
    return false;
}

// A binding like the one at `from`, for another symbol.
void bind_alike(Extraction& x, Link instance, size_t from, const std::string& symbol,
                MeshInstance& mesh, uint32_t node_number, uint32_t mesh_number) {
    const MaterialBinding& model = mesh.materials[from];
    size_t inputs = model.vertex_inputs.size() + 1;
    if (!x.budget.reserve(sizeof(MaterialBinding) + inputs * 128, x.where(instance))) return;
    MaterialBinding binding = model;
    binding.symbol = symbol;
    uint32_t number = uint32_t(mesh.materials.size());
    mesh.materials.push_back(std::move(binding));
    // Its <bind>s were the last to be put off.
    size_t pending = x.pending_bindings.size();
    for (size_t p = pending; p-- > 0;) {
        const PendingBinding& bind = x.pending_bindings[p];
        if (bind.node != node_number || bind.mesh != mesh_number) break;
        if (bind.material == from &&
            x.budget.reserve(sizeof(PendingBinding) + 128, bind.binding.where))
            x.pending_bindings.push_back(
                {node_number, mesh_number, number, bind.binding, bind.doc});
    }
}

// Primitives without a material take the only one that is bound. So do those with a symbol that
// nothing binds, where nothing has the symbol that is bound.
void bind_only_material(Extraction& x, Link instance, MeshInstance& mesh, uint32_t node_number,
                        uint32_t mesh_number) {
    size_t only = mesh.materials.size();
    std::unordered_set<uint32_t> materials;
    std::unordered_set<std::string> bound;
    for (size_t m = mesh.materials.size(); m-- > 0;) {
        bound.insert(mesh.materials[m].symbol);
        if (mesh.materials[m].material == kNone) continue;
        materials.insert(mesh.materials[m].material);
        only = m;
    }
    if (materials.empty()) return;
    const GeometrySymbols& symbols = symbols_of(x, mesh.geometry);
    bool used = false;
    for (const std::string& symbol : bound)
        used = used || (!symbol.empty() && symbols.first_group.count(symbol));
    const std::vector<PrimitiveGroup>& groups = x.scene.geometries[mesh.geometry].groups;
    auto bind = [&](uint32_t first) {
        const PrimitiveGroup& group = groups[first];
        if (bound.count(group.material)) return;
        if (materials.size() == 1) {
            bind_alike(x, instance, only, group.material, mesh, node_number, mesh_number);
            if (!group.material.empty())
                x.diag.report(Code::MAT_ONLY_BOUND, x.where(instance), group.material,
                              x.scene.materials[*materials.begin()].id);
        } else if (group.material.empty()) {
            x.diag.report(Code::MAT_AMBIGUOUS, group.where, materials.size());
        }
    };
    auto plain = symbols.first_group.find("");
    if (!used)
        for (uint32_t first : symbols.groups) bind(first);
    else if (plain != symbols.first_group.end())
        bind(plain->second);
}

void report_unbound(Extraction& x, Link instance, const MeshInstance& mesh) {
    if (mesh.materials.empty()) {
        x.diag.report(Code::MAT_NO_BIND, x.where(instance));
        return;
    }
    // Of very many the first ones are named: a mesh of them may have as many instances.
    constexpr int kMostNamed = 16;
    std::unordered_set<std::string_view> bound;
    for (const MaterialBinding& m : mesh.materials) bound.insert(m.symbol);
    const std::vector<PrimitiveGroup>& groups = x.scene.geometries[mesh.geometry].groups;
    int named = 0;
    for (uint32_t first : symbols_of(x, mesh.geometry).groups) {
        const std::string& symbol = groups[first].material;
        if (symbol.empty() || bound.count(symbol)) continue;
        x.diag.report(Code::MAT_UNBOUND_SYMBOL, x.where(instance), symbol);
        if (++named == kMostNamed) break;
    }
}

}  // namespace

// Once a geometry. The views are of its groups, which stay where they are.
GeometrySymbols& symbols_of(Extraction& x, uint32_t geometry) {
    auto [at, fresh] = x.symbols_of_geometry.try_emplace(geometry);
    GeometrySymbols& symbols = at->second;
    if (!fresh) return symbols;
    const std::vector<PrimitiveGroup>& groups = x.scene.geometries[geometry].groups;
    for (uint32_t g = 0; g < groups.size(); ++g)
        if (symbols.first_group.try_emplace(groups[g].material, g).second)
            symbols.groups.push_back(g);
    return symbols;
}

void read_mesh_instance(Extraction& x, Link link, Node& node, uint32_t node_number) {
    bool controlled = link.element->name == "instance_controller";
    Link target = controlled ? resolve(x, link, "url", {"controller"})
                             : resolve(x, link, "url", {"geometry"});
    if (!target) return;
    MeshInstance mesh;
    mesh.where = x.where(link, "url");
    if (controlled) {
        if (!read_controller(x, target, mesh)) return;
    } else {
        mesh.geometry = geometry_index(x, target);
    }
    if (mesh.geometry == kNone) return;
    // A skin's numbers are its controller's; all else moves the mesh as it is.
    uint32_t own = mesh.skin == kNone ? x.geometry_frames[mesh.geometry] : x.skin_frames[mesh.skin];
    mesh.conversion = x.frames.conversion(x.frames.of(link), own);
    uint32_t mesh_number = uint32_t(node.meshes.size());
    read_bind_material(x, link, mesh, node_number, mesh_number);
    bind_only_material(x, link, mesh, node_number, mesh_number);
    report_unbound(x, link, mesh);
    mesh.lights = read_light_list(x, link);
    if (!mesh.lights) mesh.lights = read_light_list(x, {link.doc, link.element->parent});
    for (MaterialBinding& binding : mesh.materials) bind_texcoords(x, mesh.geometry, binding);
    if (mesh.skin != kNone) {
        for (const Element& child : link.element->children())
            if (child.name == "skeleton")
                if (Link root = resolve(x, {link.doc, &child}, "", {"node", "visual_scene"})) {
                    // All of a scene: as if there were no <skeleton>.
                    bool below = root.element->name == "node";
                    uint32_t index = below ? node_index(x, root) : kNone;
                    if (index != kNone) mesh.skeleton_roots.push_back(index);
                }
        x.pending_skins.push_back({node_number, mesh_number, link});
    }
    node.meshes.push_back(std::move(mesh));
}

namespace {

// An <instance_*> of one definition, put behind `instances`.
template <class Instance>
void read_instance(Extraction& x, Link link, std::string_view name,
                   uint32_t (*index_of)(Extraction&, Link), std::vector<Instance>& instances) {
    Link target = resolve(x, link, "url", {name});
    if (!target) return;
    uint32_t index = index_of(x, target);
    if (index == kNone) return;
    instances.push_back({index, x.conversion(link, target), x.where(link, "url")});
}

}  // namespace

void read_light_instance(Extraction& x, Link link, Node& node) {
    read_instance(x, link, "light", light_index, node.lights);
}
void read_camera_instance(Extraction& x, Link link, Node& node) {
    read_instance(x, link, "camera", camera_index, node.cameras);
}
void read_node_instance(Extraction& x, Link link, Node& node) {
    read_instance(x, link, "node", node_index, node.instances);
}

}  // namespace kinora::collada
