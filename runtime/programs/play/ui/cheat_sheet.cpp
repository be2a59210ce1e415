// runtime/programs/play/ui/cheat_sheet.cpp: all keys at a glance, by menu.
#include <algorithm>
#include <string>
#include <vector>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

struct Group {
    std::string title;
    std::vector<const Command*> rows;
};

std::vector<Group> groups() {
    std::vector<Group> out;
    for (const Command& command : commands()) {
        if (!*command.key) continue;
        const std::string menu = command.menu;
        const std::string title = menu.empty() ? "Other" : menu.substr(0, menu.find('/'));
        auto group =
            std::find_if(out.begin(), out.end(), [&](const Group& g) { return g.title == title; });
        if (group == out.end()) group = out.insert(out.end(), {title, {}});
        group->rows.push_back(&command);
    }
    return out;
}

constexpr const char* kMouse[][2] = {
    {"Left", "Orbits; a click picks the pixel."},
    {"Shift+Left, Middle", "Pans; a middle click sets the pivot."},
    {"Wheel, Right", "Moves nearer and away."},
    {"Ctrl+Left", "Looks around."},
    {"Right, W A S D Q E", "Flies; the mouse looks around."},
};

// A key as a small plate.
float key_plate(const Theme& theme, ImDrawList* list, ImVec2 at, const std::string& key) {
    const ImVec2 extent = ImGui::CalcTextSize(key.c_str());
    const ImVec2 high{at.x + extent.x + theme.px(12), at.y + extent.y + theme.px(4)};
    list->AddRectFilled(at, high, theme.raised, theme.px(4));
    list->AddRect(at, high, theme.line, theme.px(4));
    list->AddText({at.x + theme.px(6), at.y + theme.px(2)}, theme.accent, key.c_str());
    return high.x - at.x;
}

float keys_width(const Theme& theme, const std::string& keys) {
    return ImGui::CalcTextSize(keys.c_str()).x +
           theme.px(12) * static_cast<float>(1 + std::count(keys.begin(), keys.end(), ' '));
}

}  // namespace

void draw_cheat_sheet(Context& context) {
    const Theme& theme = context.theme;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float margin = theme.px(40), line = ImGui::GetTextLineHeight() + theme.px(9);
    const ImVec2 size{std::min(display.x - 2 * margin, theme.px(1180)),
                      std::min(display.y - 2 * margin, theme.px(760))};
    ImGui::SetNextWindowPos(
        {std::round((display.x - size.x) / 2), std::round((display.y - size.y) / 2)});
    ImGui::SetNextWindowSize(size);
    ImGui::SetNextWindowBgAlpha(0.97f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(24), theme.px(18)});
    ImGui::Begin(
        "##cheat_sheet", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar(3);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 corner = ImGui::GetCursorScreenPos(), space = ImGui::GetContentRegionAvail();
    const int columns = std::max(1, static_cast<int>(space.x / theme.px(350)));
    const float width = space.x / static_cast<float>(columns);
    float x = corner.x, y = corner.y, keys = theme.px(120);
    const auto next_column = [&] {
        x += width;
        y = corner.y;
    };
    const auto title = [&](const char* text, size_t rows) {
        if (y > corner.y &&
            y + line * static_cast<float>(std::min<size_t>(rows, 3) + 1) > corner.y + space.y)
            next_column();
        list->AddText(theme.fonts.bold, ImGui::GetFontSize(), {x, y}, theme.text, text);
        y += line;
    };
    const auto row = [&](const std::string& plates, const char* help) {
        if (y + line > corner.y + space.y) next_column();
        float at = x;
        size_t begin = 0;
        while (begin < plates.size()) {
            const bool mouse = plates.find(',') != std::string::npos;
            const size_t end =
                mouse ? plates.size() : std::min(plates.find(' ', begin), plates.size());
            at += key_plate(theme, list, {at, y}, plates.substr(begin, end - begin)) + theme.px(4);
            begin = end + 1;
        }
        list->PushClipRect({x, y}, {x + width - theme.px(14), y + line}, true);
        list->AddText({std::max(x + keys, at + theme.px(4)), y + theme.px(2)}, theme.dim, help);
        list->PopClipRect();
        y += line;
    };
    title("Mouse", 3);
    for (const auto& one : kMouse) row(one[0], one[1]);
    for (const Group& group : groups()) {
        y += theme.px(8);
        keys = theme.px(64);
        for (const Command* command : group.rows)
            keys = std::max(keys, keys_width(theme, command->key) + theme.px(8));
        keys = std::min(keys, theme.px(150));
        title(group.title.c_str(), group.rows.size());
        for (const Command* command : group.rows) {
            const std::string menu = command->menu;
            row(command->key, menu.empty() ? command->help : command->menu + menu.rfind('/') + 1);
        }
    }
    ImGui::End();
}

}  // namespace kinora::play
