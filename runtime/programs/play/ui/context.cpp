// runtime/programs/play/ui/context.cpp: commands with messages, and small widgets.
#include "runtime/programs/play/ui/context.h"

#include <fmt/format.h>

#include <algorithm>

namespace kinora::play {

bool Context::told(const CommandResult& result) {
    if (!result.message.empty()) say(result.message, !result.done);
    return result.done;
}

bool Context::run(std::string_view word, const std::vector<std::string>& arguments) {
    return told(player.run(word, arguments));
}

bool Context::run_line(const std::string& line) {
    return told(player.run_line(line));
}

void Context::ask(const Command& command) {
    palette = std::string(command.word) + " ";
    if (!open("commands")) run("commands");
}

void Context::say(std::string text, bool fault) {
    const double seconds = fault ? 6 : 3;
    toast = {std::move(text), fault, ImGui::GetTime() + seconds};
}

bool Context::open(std::string_view panel) const {
    const auto& panels = state().panels;
    return std::find(panels.begin(), panels.end(), panel) != panels.end();
}

void Context::toggle(std::string_view panel) {
    run("panel", {std::string(panel)});
}

void Context::show(std::string_view panel) {
    if (!open(panel)) toggle(panel);
    to_front = panel;
}

std::string short_number(double value) {
    std::string text = fmt::format("{:.3f}", value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

bool toggle_button(const Theme& theme, const char* label, bool on, const char* help) {
    if (on) {
        ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(0x4a, 0x3b, 0x25, 255));
        ImGui::PushStyleColor(ImGuiCol_Text, theme.accent);
    }
    const bool pressed = ImGui::SmallButton(label);
    if (on) ImGui::PopStyleColor(2);
    if (help && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return pressed;
}

void command_tooltip(std::string_view word) {
    const Command* command = find_command(word);
    if (!command || !ImGui::IsItemHovered()) return;
    if (*command->key)
        ImGui::SetTooltip("%s  (%s)", command->help, command->key);
    else
        ImGui::SetTooltip("%s", command->help);
}

void empty_note(const Theme& theme, const char* text) {
    ImGui::Dummy({0, theme.px(6)});
    ImGui::PushStyleColor(ImGuiCol_Text, theme.dim);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

}  // namespace kinora::play
