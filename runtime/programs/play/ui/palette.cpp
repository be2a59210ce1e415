// runtime/programs/play/ui/palette.cpp: any command by name.
#include <algorithm>
#include <cctype>
#include <cstring>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

constexpr size_t kShown = 12;

// How well the letters fit, in order, anywhere in the text: 0 not at all. Runs and beginnings of
// words count more.
int fit(std::string_view letters, std::string_view text) {
    int score = 1, run = 0;
    size_t at = 0;
    for (char letter : letters) {
        if (letter == ' ') continue;
        bool found = false;
        for (; at < text.size() && !found; ++at) {
            const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
            if (lower(text[at]) != lower(letter)) {
                run = 0;
                continue;
            }
            const bool begins =
                at == 0 || text[at - 1] == ' ' || text[at - 1] == '_' || text[at - 1] == '/';
            score += 1 + 3 * run + (begins ? 4 : 0);
            ++run;
            found = true;
        }
        if (!found) return 0;
    }
    return score;
}

}  // namespace

void Palette::find() {
    searched_ = text_;
    found_.clear();
    chosen_ = 0;
    const std::string word = searched_.substr(0, searched_.find(' '));
    std::vector<std::pair<int, const Command*>> scored;
    for (const Command& command : commands()) {
        int score = std::max({2 * fit(searched_, command.word), 2 * fit(searched_, command.menu),
                              fit(searched_, command.help)});
        if (word == command.word) score = 100000;
        if (score > 0) scored.push_back({score, &command});
    }
    std::stable_sort(scored.begin(), scored.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [score, command] : scored) found_.push_back(command);
}

// A whole line runs as it stands. A name alone becomes the chosen row's word; a row that needs
// arguments waits for them.
void Palette::execute(Context& context) {
    const std::string line = text_;
    const std::string word = line.substr(0, line.find(' '));
    const Command* named = find_command(word);
    if (named && line.find_first_not_of(' ', word.size()) != std::string::npos) {
        if (context.run_line(line)) open_ = false;
        return;
    }
    if (chosen_ >= found_.size()) return;
    const Command& command = *found_[chosen_];
    if (*command.arguments && command.arguments[0] != '[') {
        std::snprintf(text_, sizeof text_, "%s ", command.word);
        focus_ = true;
        return;
    }
    open_ = false;
    context.run(command.word);
}

void Palette::draw(Context& context, bool wanted) {
    if (wanted && (!open_ || !context.palette.empty())) {
        open_ = focus_ = true;
        std::snprintf(text_, sizeof text_, "%s", context.palette.c_str());
        context.palette.clear();
        find();
    }
    open_ = wanted;
    if (!open_) return;
    const Theme& theme = context.theme;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float width = std::min(theme.px(640), display.x - theme.px(40));
    ImGui::SetNextWindowPos({std::round((display.x - width) / 2), theme.px(70)});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(12), theme.px(12)});
    ImGui::Begin(
        "##palette", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar(3);
    const bool fresh = focus_;
    if (focus_) {
        ImGui::SetWindowFocus();
        ImGui::SetKeyboardFocusHere();
    }
    focus_ = false;
    ImGui::SetNextItemWidth(-1);
    // The caret belongs behind a word that waits for its arguments.
    const auto to_end = [](ImGuiInputTextCallbackData* data) {
        if (data->SelectionStart != data->SelectionEnd && data->BufTextLen > 0 &&
            data->Buf[data->BufTextLen - 1] == ' ') {
            data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
        }
        return 0;
    };
    const bool entered = ImGui::InputTextWithHint(
        "##command", "a command, or what it does", text_, sizeof text_,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackAlways, to_end);
    if (searched_ != text_) find();
    const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    if (pressed(ImGuiKey_DownArrow) && chosen_ + 1 < found_.size()) ++chosen_;
    if (pressed(ImGuiKey_UpArrow) && chosen_ > 0) --chosen_;
    if (pressed(ImGuiKey_Escape)) open_ = false;
    ImGui::Dummy({0, theme.px(4)});
    bool clicked = false;
    const size_t first = chosen_ < kShown ? 0 : chosen_ - kShown + 1;
    for (size_t i = first; i < std::min(found_.size(), first + kShown); ++i) {
        const Command& command = *found_[i];
        ImGui::PushID(static_cast<int>(i));
        const float left = ImGui::GetCursorPosX(), whole = ImGui::GetContentRegionAvail().x;
        if (ImGui::Selectable("##row", i == chosen_)) {
            chosen_ = i;
            clicked = true;
        }
        ImGui::SameLine(left + theme.px(6));
        ImGui::TextUnformatted(command.word);
        ImGui::SameLine();
        ImGui::TextDisabled("%s", command.arguments);
        ImGui::SameLine(std::max(left + whole * 0.36f, ImGui::GetItemRectMax().x -
                                                           ImGui::GetWindowPos().x + theme.px(12)));
        const float key = ImGui::CalcTextSize(command.key).x;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float limit = ImGui::GetWindowPos().x + left + whole - key - theme.px(16);
        ImGui::PushClipRect(at, {limit, at.y + ImGui::GetTextLineHeightWithSpacing()}, true);
        ImGui::TextDisabled("%s", command.help);
        ImGui::PopClipRect();
        ImGui::SameLine(left + whole - key - theme.px(6));
        ImGui::PushStyleColor(ImGuiCol_Text, theme.accent);
        ImGui::TextUnformatted(command.key);
        ImGui::PopStyleColor();
        ImGui::PopID();
    }
    if (found_.empty()) ImGui::TextDisabled("No command of this name.");
    if (entered || clicked) execute(context);
    if (!fresh && !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows)) open_ = false;
    ImGui::End();
}

}  // namespace kinora::play
