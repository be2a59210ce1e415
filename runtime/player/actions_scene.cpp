// runtime/player/actions_scene.cpp: selection, and what changes the scene.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/player/core_p.h"
#include "runtime/player/session/places.h"

namespace kinora {

namespace {

// The node of that path, id or name; null after a refusal.
const NodeInfo* find_node_info(const PlayerCore& core, const std::string& wanted,
                               CommandResult& result) {
    if (!core.info) {
        result = refused("there is no scene yet");
        return nullptr;
    }
    std::vector<std::string> known;
    for (const NodeInfo& node : core.info->nodes) {
        std::string id = node.path.substr(node.path.rfind('/') + 1);
        if (wanted == node.path || wanted == node.name || wanted == id) return &node;
        known.insert(known.end(), {node.path, node.name, id});
    }
    result = refused(unknown_name("node", wanted, known), 1);
    return nullptr;
}

const MaterialInfo* find_material_info(const PlayerCore& core, const std::string& wanted,
                                       CommandResult& result) {
    if (!core.info) {
        result = refused("there is no scene yet");
        return nullptr;
    }
    std::vector<std::string> known;
    for (const MaterialInfo& material : core.info->materials) {
        if (wanted == material.id || wanted == material.name) return &material;
        known.push_back(material.id);
    }
    result = refused(unknown_name("material", wanted, known), 1);
    return nullptr;
}

}  // namespace

CommandResult action_click(PlayerCore& core, const Arguments& a) {
    if (!core.info) return refused("there is no scene yet");
    int x = int(a.number(0)), y = int(a.number(1));
    core.inspect(true, [&core, x, y](Inspected& inspected) -> Answer {
        PickedPixel picked = pick_pixel(inspected, x, y);
        auto story = picked.hit ? story_of(inspected, x, y) : nullptr;
        return [&core, picked, story, order = inspected.order] {
            core.state.selection.node = picked.node;
            core.state.selection.material = picked.material;
            core.state.selection.pixel = picked;
            core.state.selection.story = story;
            core.picked_in = order;
            core.color_pick();
        };
    });
    return {};
}

CommandResult action_select(PlayerCore& core, const Arguments& a) {
    CommandResult result;
    if (const NodeInfo* node = find_node_info(core, a.text(0), result)) {
        core.state.selection.node = node->path;
        if (!node->materials.empty()) core.state.selection.material = node->materials.front();
        core.state.selection.pixel.reset();
        core.state.selection.story.reset();
    }
    return result;
}

CommandResult action_select_material(PlayerCore& core, const Arguments& a) {
    CommandResult result;
    if (const MaterialInfo* material = find_material_info(core, a.text(0), result))
        core.state.selection.material = material->id;
    return result;
}

CommandResult action_deselect(PlayerCore& core, const Arguments&) {
    if (core.cancel_open()) return refused("the scene is not opened");
    core.state.selection = {};
    return {};
}

CommandResult action_param(PlayerCore& core, const Arguments& a) {
    const std::string& material = core.state.selection.material;
    if (material.empty()) return refused("no material is selected");
    if (a.has(2) && a.text(2) != "further") return refused("param takes further, or nothing", 3);
    core.typing = false;
    SceneEdits edits = core.edits;
    CommandResult known;
    const MaterialInfo* info = find_material_info(core, material, known);
    if (!info) return known;
    const std::string target = info->target + "." + a.text(0);
    auto found = std::ranges::find_if(edits.params, [&](auto& p) { return p.first == target; });
    if (found == edits.params.end())
        edits.params.emplace_back(target, a.text(1));
    else
        found->second = a.text(1);
    if (a.has(2) && core.dragged == target) {  // undo takes the whole drag back
        core.edits = std::move(edits);
        core.rebuild();
    } else {
        core.change_scene(std::move(edits));
    }
    core.dragged = target;
    return {};
}

CommandResult action_hide(PlayerCore& core, const Arguments& a) {
    std::string wanted = a.text_or(0, core.state.selection.node);
    if (wanted.empty()) return refused("no node is selected");
    CommandResult result;
    const NodeInfo* node = find_node_info(core, wanted, result);
    if (!node) return result;
    const std::string id = node->path.substr(node->path.rfind('/') + 1);
    if (id == number_name(uint32_t(node - core.info->nodes.data())))
        return refused("the file gives this node neither an id nor a name to be hidden by");
    SceneEdits edits = core.edits;
    edits.hidden.push_back(id);
    core.change_scene(std::move(edits));
    return {};
}

CommandResult action_undo(PlayerCore& core, const Arguments&) {
    if (core.undo.empty()) return refused("nothing was changed");
    core.redo.push_back(std::move(core.edits));
    core.edits = std::move(core.undo.back());
    core.undo.pop_back();
    core.restore_text();
    core.rebuild();
    return {};
}

CommandResult action_redo(PlayerCore& core, const Arguments&) {
    if (core.redo.empty()) return refused("nothing was taken back");
    core.undo.push_back(std::move(core.edits));
    core.edits = std::move(core.redo.back());
    core.redo.pop_back();
    core.restore_text();
    core.rebuild();
    return {};
}

CommandResult action_reload(PlayerCore& core, const Arguments&) {
    if (core.request.scene.empty()) return refused("there is no scene yet");
    core.forget_stops();
    core.open_again();
    return {};
}

CommandResult action_quit(PlayerCore& core, const Arguments&) {
    core.state.quit = true;
    return {};
}

}  // namespace kinora
