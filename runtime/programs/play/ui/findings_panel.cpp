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

// To the line in the editor where the file is a shader's; else the place goes to the clipboard.
void jump(Context& context, const FindingText& finding, bool of_shader) {
    if (of_shader || context.player.run("edit", {finding.file}).done) {
        context.show("editor");
        if (finding.line)
            context.run("caret", {fmt::format("{}", finding.line),
                                  fmt::format("{}", std::max(1, finding.column))});
        return;
    }
    const std::string location =
        fmt::format("{}:{}:{}", finding.file, finding.line, finding.column);
    ImGui::SetClipboardText(location.c_str());
    context.say(fmt::format("Copied {}", location));
}

void row(Context& context, const FindingText& finding, bool of_shader) {
    const Theme& theme = context.theme;
    const ImU32 color = finding.severity == "error"     ? theme.error
                        : finding.severity == "warning" ? theme.warning
                                                        : theme.dim;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##finding", false, ImGuiSelectableFlags_SpanAllColumns))
        jump(context, finding, of_shader);
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
    const ShaderDocument& shader = context.player.shader();
    if (findings.empty() && shader.findings.empty())
        return empty_note(context.theme, "Nothing was found: neither an error nor a warning.");
    const float px = context.theme.px(1);
    if (!ImGui::BeginTable(
            "findings", 4,
            ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY))
        return;
    ImGui::TableSetupColumn("", 0, 14 * px);
    ImGui::TableSetupColumn("message", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("place", 0, 190 * px);
    ImGui::TableSetupColumn("code", 0, 200 * px);
    int id = 0;
    for (const auto* some : {&shader.findings, &findings})
        for (const FindingText& finding : *some) {
            ImGui::PushID(id++);
            row(context, finding, some == &shader.findings);
            ImGui::PopID();
        }
    ImGui::EndTable();
}

}  // namespace kinora::play
