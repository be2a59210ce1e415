// runtime/programs/play/ui/nodes_panel.cpp: the tree of nodes.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

bool contains(const std::string& text, const std::string& part) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) ==
               std::tolower(static_cast<unsigned char>(b));
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

const char* kind_of(const NodeInfo& node) {
    if (node.deforms) return "deforms";
    return node.moves ? "moves" : "stands";
}

}  // namespace

// With a filter: all that match, without the closed parents in between.
void NodesPanel::list(const SceneInfo& scene) {
    shown_.clear();
    has_children_.assign(scene.nodes.size(), 0);
    std::vector<char> hidden(scene.nodes.size(), 0);
    for (uint32_t i = 0; i < scene.nodes.size(); ++i) {
        const NodeInfo& node = scene.nodes[i];
        if (node.parent < i) {
            has_children_[node.parent] = 1;
            hidden[i] = hidden[node.parent] || closed_.count(node.parent);
        }
        if (filter_.empty() ? !hidden[i] : contains(node.name, filter_)) shown_.push_back(i);
    }
}

void NodesPanel::row(Context& context, const SceneInfo& scene, size_t index) {
    const Theme& theme = context.theme;
    const uint32_t n = shown_[index];
    const NodeInfo& node = scene.nodes[n];
    const bool selected = context.state().selection.node == node.path;
    ImGui::PushID(static_cast<int>(n));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight() + theme.px(6),
                width = ImGui::GetContentRegionAvail().x;
    const float indent = filter_.empty() ? theme.px(13) * static_cast<float>(node.depth) : 0;
    const bool clicked =
        ImGui::Selectable("##node", selected, 0, {width, height - ImGui::GetStyle().ItemSpacing.y});
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float middle = corner.y + (height - ImGui::GetStyle().ItemSpacing.y) / 2,
                r = theme.px(3.5f);
    float x = corner.x + indent + theme.px(8);
    const bool on_arrow = hovered && has_children_[n] && filter_.empty() &&
                          ImGui::GetIO().MousePos.x < x + theme.px(8);
    if (has_children_[n] && filter_.empty()) {
        const ImU32 color = on_arrow ? theme.text : theme.dim;
        if (closed_.count(n))
            list->AddTriangleFilled({x - r * 0.6f, middle - r}, {x + r * 0.9f, middle},
                                    {x - r * 0.6f, middle + r}, color);
        else
            list->AddTriangleFilled({x - r, middle - r * 0.6f}, {x + r, middle - r * 0.6f},
                                    {x, middle + r * 0.9f}, color);
    }
    x += theme.px(15);
    const ImU32 dot = node.deforms ? theme.good : node.moves ? theme.accent : theme.faint;
    list->AddCircleFilled({x, middle}, theme.px(3), dot, 12);
    const float text_y = middle - ImGui::GetFontSize() / 2;
    const ImU32 ink = node.triangles || has_children_[n] ? theme.text : theme.dim;
    list->AddText({x + theme.px(10), text_y}, ink, node.name.c_str());
    if (clicked && on_arrow) {
        if (!closed_.erase(n)) closed_.insert(n);
        shown_filter_ = "\n";  // list anew
    } else if (clicked && context.has("select")) {
        selected_ = node.path;
        context.run("select", {node.path});
    }
    if (hovered && !on_arrow) {
        ImGui::BeginTooltip();
        ImGui::TextUnformatted(node.path.c_str());
        ImGui::TextDisabled("%s, %u triangles", kind_of(node), node.triangles);
        for (const std::string& material : node.materials)
            ImGui::TextDisabled("material %s", material.c_str());
        ImGui::EndTooltip();
    }
    ImGui::PopID();
}

void NodesPanel::draw(Context& context) {
    const auto scene = context.player.scene();
    if (!scene) return empty_note(context.theme, "No scene is open.");
    if (scene_ != scene->serial) closed_.clear();
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "find a node", &filter_);
    if (scene_ != scene->serial || filter_ != shown_filter_) {
        list(*scene);
        scene_ = scene->serial;
        shown_filter_ = filter_;
    }
    ImGui::BeginChild("nodes");
    const float height = ImGui::GetTextLineHeight() + context.theme.px(6);
    // A click on the picture selects a node: it comes into view.
    const std::string& selected = context.state().selection.node;
    if (selected != selected_) {
        selected_ = selected;
        const auto at = std::find_if(shown_.begin(), shown_.end(),
                                     [&](uint32_t n) { return scene->nodes[n].path == selected; });
        if (at != shown_.end())
            ImGui::SetScrollY(std::max(0.0f, height * static_cast<float>(at - shown_.begin()) -
                                                 ImGui::GetWindowHeight() / 2));
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(shown_.size()), height);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            row(context, *scene, static_cast<size_t>(i));
    ImGui::EndChild();
}

}  // namespace kinora::play
