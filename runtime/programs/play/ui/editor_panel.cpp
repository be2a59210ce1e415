// runtime/programs/play/ui/editor_panel.cpp: the editor beside the player's shader.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

// The player's text is the truth: scripts, undo and changes on the disk come from there.
void EditorPanel::follow(const ShaderDocument& document) {
    TextBuffer& buffer = pane_.buffer();
    if (document.material != material_) {
        material_ = document.material;
        buffer.reset(document.text);
        version_ = document.version;
        caret_ = SIZE_MAX;
    } else if (document.version != version_) {
        version_ = document.version;
        buffer.replace_all(document.text);
    }
    if (document.caret != caret_) {
        caret_ = document.caret;
        if (buffer.caret() != caret_) {
            buffer.set_caret(caret_);
            pane_.show_caret();
        }
    }
}

void EditorPanel::toolbar(Context& context, const ShaderDocument& document) {
    const Theme& theme = context.theme;
    const std::string file = std::filesystem::path(document.file).filename().string();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(document.material.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%s%s", file.c_str(), document.embedded ? ", <code>" : "");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", document.file.c_str());
    size_t errors = 0;
    for (const FindingText& finding : document.findings) errors += finding.severity == "error";
    std::string status;
    ImU32 color = theme.dim;
    if (errors) {
        status = fmt::format("{} error{}", errors, errors == 1 ? "" : "s");
        color = theme.error;
    } else if (document.compiling) {
        status = "compiling";
    } else {
        status =
            document.compile_ms > 0 ? fmt::format("{:.1f} ms", document.compile_ms) : "no errors";
        color = theme.good;
    }
    const bool can_save = Context::has("save") && document.dirty;
    const float save = can_save ? ImGui::CalcTextSize("Save").x + theme.px(24) : 0;
    const float width = ImGui::CalcTextSize(status.c_str()).x + theme.px(20) + save;
    ImGui::SameLine(std::max(theme.px(40), ImGui::GetWindowContentRegionMax().x - width));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddCircleFilled(
        {at.x + theme.px(5), at.y + ImGui::GetFrameHeight() / 2}, theme.px(4), color, 16);
    ImGui::SetCursorScreenPos({at.x + theme.px(15), at.y});
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(status.c_str());
    ImGui::PopStyleColor();
    if (!can_save) return;
    ImGui::SameLine();
    if (ImGui::SmallButton("Save")) context.run("save");
    command_tooltip("save");
}

// The shader of what is selected comes into the editor, once a selection: where it cannot be
// edited, the one before stays.
void EditorPanel::follow_selection(Context& context) {
    const std::string& selected = context.state().selection.material;
    if (selected == selected_ || !Context::has("edit")) return;
    selected_ = selected;
    if (selected.empty() || selected == context.player.shader().material) return;
    if (context.player.shader().dirty) return;  // not away from work that was not saved
    context.player.run("edit", {});
}

void EditorPanel::draw(Context& context) {
    follow_selection(context);
    const ShaderDocument& document = context.player.shader();
    if (document.material.empty()) {
        pane_.focus(false);
        return empty_note(
            context.theme,
            "Choose a material, or click on something in the picture, to edit its shader.");
    }
    follow(document);
    toolbar(context, document);
    const float hint_height = 2 * ImGui::GetTextLineHeight() + context.theme.px(14);
    ImGui::BeginChild("editor", {0, -hint_height}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    std::vector<EditorMark> marks;
    for (const FindingText& finding : document.findings)
        if (finding.begin <= document.text.size() && finding.line > 0)
            marks.push_back(
                {finding.begin, finding.end, finding.severity == "error", finding.message});
    ImGui::PushFont(context.theme.fonts.mono);
    const bool changed = pane_.draw("text", marks);
    ImGui::PopFont();
    ImGui::EndChild();
    TextBuffer& buffer = pane_.buffer();
    if (changed && Context::has("set_text")) {
        context.run("set_text", {buffer.text()});
        version_ = context.player.shader().version;
        caret_ = context.player.shader().caret;
    }
    if (buffer.caret() != caret_ && Context::has("caret")) {
        const size_t line = buffer.line_of(buffer.caret());
        context.player.run("caret",
                           {fmt::format("{}", line + 1),
                            fmt::format("{}", buffer.caret() - buffer.line_begin(line) + 1)});
        caret_ = context.player.shader().caret;
    }
    // What is wrong in the caret's line goes before the manual.
    ManualLine hint = pane_.hint();
    const int line = static_cast<int>(buffer.line_of(buffer.caret())) + 1;
    const auto fault =
        std::find_if(document.findings.begin(), document.findings.end(),
                     [&](const FindingText& finding) { return finding.line == line; });
    const bool wrong = fault != document.findings.end();
    if (wrong) hint = {fault->message, fault->help};
    ImGui::Dummy({0, context.theme.px(1)});
    ImGui::PushFont(wrong ? context.theme.fonts.text : context.theme.fonts.mono);
    ImGui::PushStyleColor(ImGuiCol_Text, wrong ? context.theme.error : context.theme.good);
    ImGui::TextUnformatted(hint.form.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::TextDisabled("%s", hint.text.c_str());
    if (ImGui::IsItemHovered() && !hint.text.empty())
        ImGui::SetTooltip("%s\n%s", hint.form.c_str(), hint.text.c_str());
}

}  // namespace kinora::play
