// runtime/programs/play/ui/findings_panel.cpp: findings, which lead to their places.
#include <fmt/format.h>

#include <filesystem>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

std::string place_of(const FindingText& finding) {
    if (finding.file.empty()) return {};
    const std::string file = std::filesystem::path(finding.file).filename().string();
    return finding.line ? fmt::format("{}:{}:{}", file, finding.line, finding.column) : file;
}

void row(Context& context, const FindingText& finding, size_t number) {
    const Theme& theme = context.theme;
    const ImU32 color = finding.severity == "error"     ? theme.error
                        : finding.severity == "warning" ? theme.warning
                                                        : theme.dim;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##finding", context.state().finding == number,
                          ImGuiSelectableFlags_SpanAllColumns))
        context.run("finding", {fmt::format("{}", number)});
    if (ImGui::IsItemHovered()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(theme.px(520));
        ImGui::TextUnformatted(finding.message.c_str());
        if (!finding.help.empty()) ImGui::TextDisabled("help: %s", finding.help.c_str());
        if (!finding.file.empty()) ImGui::TextDisabled("%s", finding.file.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
    ImGui::GetWindowDrawList()->AddCircleFilled(
        {at.x + theme.px(6), at.y + ImGui::GetTextLineHeight() / 2}, theme.px(4), color, 16);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(finding.message.c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", place_of(finding).c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", finding.code.c_str());
}

}  // namespace

void draw_findings(Context& context) {
    const auto& findings = context.player.findings();
    if (findings.empty())
        return empty_note(context.theme, "Nothing was found: neither an error nor a warning.");
    const float px = context.theme.px(1);
    if (!ImGui::BeginTable(
            "findings", 4,
            ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY))
        return;
    ImGui::TableSetupColumn("", 0, 14 * px);
    ImGui::TableSetupColumn("message", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("place");
    ImGui::TableSetupColumn("code");
    for (size_t k = 0; k < findings.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        row(context, findings[k], k + 1);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

}  // namespace kinora::play
