// runtime/programs/play/ui/menu.cpp: the menu bar, from the rows of the table of commands.
#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

struct Entry {
    std::vector<std::string> path;
    const Command* command;
};

std::vector<Entry> entries() {
    std::vector<Entry> out;
    for (const Command& command : commands()) {
        if (!*command.menu) continue;
        Entry entry{{""}, &command};
        for (const char* c = command.menu; *c; ++c) {
            if (*c == '/')
                entry.path.emplace_back();
            else
                entry.path.back() += *c;
        }
        out.push_back(std::move(entry));
    }
    // The usual order of menus; further ones stand before the last two, as the table has them.
    const auto rank = [](const Entry& entry) {
        constexpr const char* kFirst[] = {"File", "Edit", "View"};
        constexpr const char* kLast[] = {"Window", "Help"};
        for (int i = 0; i < 3; ++i)
            if (entry.path[0] == kFirst[i]) return i;
        for (int i = 0; i < 2; ++i)
            if (entry.path[0] == kLast[i]) return 4 + i;
        return 3;
    };
    std::stable_sort(out.begin(), out.end(),
                     [&](const Entry& a, const Entry& b) { return rank(a) < rank(b); });
    return out;
}

// A row runs without arguments if all of them may be left out.
bool wants_arguments(const Command& command) {
    return *command.arguments && command.arguments[0] != '[';
}

void item(Context& context, const Entry& entry) {
    const Command& command = *entry.command;
    const bool asks = wants_arguments(command);
    const std::string label = entry.path.back() + (asks ? "..." : "");
    if (ImGui::MenuItem(label.c_str(), command.key)) {
        if (asks) {
            context.ask(command);
        } else {
            context.run(command.word);
        }
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", command.help);
}

// The entries of one menu, sub-menus where their first row stands.
void level(Context& context, const std::vector<Entry>& all, const std::vector<std::string>& path) {
    std::vector<std::string> drawn;
    for (const Entry& entry : all) {
        if (entry.path.size() <= path.size() ||
            !std::equal(path.begin(), path.end(), entry.path.begin()))
            continue;
        if (entry.path.size() == path.size() + 1 && !path.empty()) {
            item(context, entry);
            continue;
        }
        const std::string& name = entry.path[path.size()];
        if (std::find(drawn.begin(), drawn.end(), name) != drawn.end()) continue;
        drawn.push_back(name);
        if (!ImGui::BeginMenu(name.c_str())) continue;
        std::vector<std::string> inner = path;
        inner.push_back(name);
        level(context, all, inner);
        ImGui::EndMenu();
    }
}

}  // namespace

void draw_menu(Context& context) {
    if (!ImGui::BeginMenuBar()) return;
    static const std::vector<Entry> all = entries();
    level(context, all, {});
    ImGui::EndMenuBar();
}

}  // namespace kinora::play
