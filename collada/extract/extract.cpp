// collada/extract/extract.cpp: the order in which what <scene> reaches is read.
#include <algorithm>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/raise_findings.h"

namespace kinora::collada {

namespace {

// The visual scene of that id, or of <scene>; else the first of the document; else null.
Link find_visual_scene(Extraction& x, uint32_t doc, const std::string& wanted) {
    const Document& document = x.document(doc);
    const Element* named = wanted.empty() ? nullptr : find_kind(document, wanted, {"visual_scene"});
    if (named) return {doc, named};
    const Element* scene = document.root().child("scene");
    const Element* instance = scene ? scene->child("instance_visual_scene") : nullptr;
    if (instance) {
        if (const Element* second = instance->next_named("instance_visual_scene"))
            x.diag.report(Code::SCENE_MULTI, x.where({doc, second}));
        Link link = resolve(x, {doc, instance}, "url", {"visual_scene"});
        if (link) return link;
    }
    for (const Element& library : document.root().children()) {
        if (library.name != "library_visual_scenes") continue;
        if (const Element* first = library.child("visual_scene")) {
            if (!instance)  // else what it names was told to be missing
                x.diag.report(Code::SCENE_MISSING, x.where({doc, scene ? scene : first}));
            return {doc, first};
        }
    }
    return {};
}

// A list that grows by doubling holds three times its content at its worst moment. What the lists
// of large structs may come to is known before.
struct ListRow {
    std::string_view element;
    void (*reserve)(SceneData&, size_t count, uint64_t most_bytes);
};

template <auto List>
void reserve(SceneData& scene, size_t count, uint64_t most_bytes) {
    auto& list = scene.*List;
    using Item = typename std::remove_reference_t<decltype(list)>::value_type;
    list.reserve(std::min<size_t>(count, most_bytes / sizeof(Item)));
}

constexpr ListRow kLists[] = {
    {"node", reserve<&SceneData::nodes>},       {"geometry", reserve<&SceneData::geometries>},
    {"camera", reserve<&SceneData::cameras>},   {"light", reserve<&SceneData::lights>},
    {"effect", reserve<&SceneData::effects>},   {"material", reserve<&SceneData::materials>},
    {"controller", reserve<&SceneData::skins>}, {"image", reserve<&SceneData::images>},
    {"sampler", reserve<&SceneData::samplers>}, {"channel", reserve<&SceneData::channels>},
};

void reserve_lists(Extraction& x, const Document& document) {
    std::unordered_map<std::string_view, size_t> counts;
    for (const Element* e = &document.root(); e;) {  // document order
        ++counts[e->name];
        if (e->first_child) {
            e = e->first_child;
            continue;
        }
        while (e && !e->next) e = e->parent;
        if (e) e = e->next;
    }
    for (const ListRow& row : kLists) {
        auto found = counts.find(row.element);
        if (found != counts.end()) row.reserve(x.scene, found->second, x.budget.most());
    }
}

// The node whose camera the scene says to look through: of the first <render> that names one in an
// <evaluate_scene> that is not switched off (1.5).
void read_evaluated_camera(Extraction& x, Link scene) {
    for (const Element& evaluate : scene.element->children()) {
        if (evaluate.name != "evaluate_scene" ||
            !parse_bool(evaluate.value("enable")).value_or(true))
            continue;
        for (const Element& render : evaluate.children()) {
            if (render.name != "render" || render.value("camera_node").empty()) continue;
            Link node = resolve(x, {scene.doc, &render}, "camera_node", {"node"});
            auto at = node ? x.made.find(node.element) : x.made.end();
            if (at == x.made.end() || x.scene.camera_node != kNone) continue;
            x.scene.camera_node = at->second;
        }
    }
}

std::vector<uint32_t> roots_of(Extraction& x, Link scene) {
    std::vector<uint32_t> roots;
    for (const Element& child : scene.element->children()) {
        if (child.name != "node") continue;
        uint32_t root = node_index(x, {scene.doc, &child});
        if (root != kNone) roots.push_back(root);
    }
    return roots;
}

// A node that holds what a model's visual scene shows, at the model's place in the world.
void place_model(Extraction& x, const PlacedModel& model, Link scene) {
    Node node;
    node.name = model.name;
    node.document = scene.doc;
    node.where = x.where(scene);
    uint32_t world = x.frames.of_world(), earth = x.frames.of_earth();
    auto conversion = [&](uint32_t from, uint32_t to) {
        uint32_t index = x.frames.conversion(from, to);
        return index == kNone ? dmat4(1.0) : x.scene.conversions[index];
    };
    dmat4 place = conversion(world, earth) * model.place * conversion(earth, world);
    Transform& transform = node.transforms.emplace_back();
    transform.kind = TransformKind::Matrix;
    transform.slot.count = 16;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) transform.slot.values[size_t(c * 4 + r)] = place[c][r];
    for (const Element& child : scene.element->children()) {
        if (child.name != "node") continue;
        Link root{scene.doc, &child};
        uint32_t index = node_index(x, root);
        if (index == kNone) continue;
        node.instances.push_back(
            {index, x.frames.conversion(world, x.frames.of(root)), x.where(root)});
    }
    if (!x.budget.reserve(sizeof(Node) + kBookBytes, node.where)) return;
    x.scene.roots.push_back(append(x.scene.nodes, std::move(node)));
    x.nodes.add_filled();
}

void place_models(Extraction& x, Link first) {
    for (const PlacedModel& model : x.options.models) {
        Location where = x.where(first);
        std::string_view file =
            std::string_view(model.document).substr(model.document.find_last_of('/') + 1);
        uint32_t doc = x.documents.at_path(model.document, file, where);
        Link scene = doc == kNone ? Link{} : find_visual_scene(x, doc, model.scene_id);
        if (scene) place_model(x, model, scene);
    }
}

void read_visual_scene(Extraction& x, Link scene) {
    x.scene.scene_id = scene.element->value("id");
    x.scene.scene_name = scene.element->value("name");
    if (x.options.models.empty())
        x.scene.roots = roots_of(x, scene);
    else
        place_models(x, scene);
    // The first root is read first, so that what it shows gets the first numbers.
    x.nodes.reverse();
    read_pending_nodes(x);
    read_evaluated_camera(x, scene);
    x.scene.rsl_materials = rsl_extra_materials(x, scene);
    read_environment(x, scene);
    read_time_range(x, scene);
}

}  // namespace

bool extract_into(Extraction& x, const Document& document) {
    x.documents.add(document, real_path(document.path()));
    Asset& asset = x.scene.documents[0].asset;
    asset.meter = x.options.meter.value_or(asset.meter);
    asset.up_axis = x.options.up_axis.value_or(asset.up_axis);
    x.scene.asset = asset;
    reserve_lists(x, document);
    Link scene = find_visual_scene(x, 0, x.options.scene_id);
    if (!scene && !x.options.everything) {
        if (!raise_findings(x.diag, "XML_"))  // what is not well-formed may have cut it off
            x.diag.report(Code::SCENE_NONE, document.location(document.root()));
        return false;
    }
    if (scene)
        read_visual_scene(x, scene);
    else  // a document may well serve as a library for others
        x.diag.report(Code::SCENE_MISSING, document.location(document.root()));
    if (x.options.everything) read_everything(x);
    check_node_graph(x);
    resolve_joints(x);
    read_animations(x);
    settle_visibility(x);
    mend_black_effects(x);
    check_transparency(x);
    return true;
}

std::optional<SceneData> extract(const Document& document, Diagnostics& diag,
                                 const ExtractOptions& options) {
    Extraction x(diag, options);
    if (!extract_into(x, document)) return std::nullopt;
    return std::move(x.scene);
}

}  // namespace kinora::collada
