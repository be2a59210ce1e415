// runtime/programs/play/ui/explained_panel.cpp: what the scene models, what it leaves out, and why.
#include <imgui.h>

#include <algorithm>
#include <span>
#include <string>

#include "runtime/picture/explain/explain.h"
#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

constexpr size_t kMostRows = 200;  // of a section: they are laid out anew each time

void explained_row(const Theme& theme, const Explained& row) {
    ImGui::PushStyleColor(ImGuiCol_Text, row.modelled ? theme.text : theme.dim);
    ImGui::TextWrapped("%s", row.subject.c_str());
    ImGui::PopStyleColor();
    ImGui::Indent(theme.px(12));
    ImGui::PushStyleColor(ImGuiCol_Text, row.modelled ? theme.good : theme.warning);
    ImGui::TextWrapped("%s%s", row.modelled ? "" : "left out: ", row.what.c_str());
    ImGui::PopStyleColor();
    if (!row.why.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, theme.dim);
        ImGui::TextWrapped("%s", row.why.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::Unindent(theme.px(12));
}

void explained_section(const Theme& theme, std::span<const Explained> rows) {
    const std::string name(rows.front().section);
    const std::string title = name + " (" + std::to_string(rows.size()) + ")###" + name;
    // The settings are many, and the same for most scenes.
    const ImGuiTreeNodeFlags open = name == "settings" ? 0 : ImGuiTreeNodeFlags_DefaultOpen;
    if (!ImGui::TreeNodeEx(title.c_str(), open)) return;
    for (const Explained& row : rows.first(std::min(rows.size(), kMostRows)))
        explained_row(theme, row);
    if (rows.size() > kMostRows)
        ImGui::TextDisabled("and %zu more: the command explain writes all",
                            rows.size() - kMostRows);
    ImGui::TreePop();
}

}  // namespace

void draw_explained(Context& context) {
    const auto rows = context.state().explained;
    if (!rows) return empty_note(context.theme, "No scene is open.");
    for (size_t first = 0, end = 0; first < rows->size(); first = end) {
        while (end < rows->size() && (*rows)[end].section == (*rows)[first].section) ++end;
        explained_section(context.theme, std::span(*rows).subspan(first, end - first));
    }
}

}  // namespace kinora::play
