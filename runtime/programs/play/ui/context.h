// runtime/programs/play/ui/context.h: what every panel is given: the player, the theme, messages.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/player/player.h"
#include "runtime/programs/play/ui/layout.h"
#include "runtime/programs/play/ui/theme.h"

namespace kinora::play {

// Something to say, shown for a while.
struct Toast {
    std::string text;
    bool fault = false;
    double until = 0;  // ImGui's time
};

class Context {
  public:
    Context(Player& the_player, const Theme& the_theme, Layout& the_layout)
        : player(the_player), theme(the_theme), layout(the_layout) {}

    // Runs a command; what it has to say becomes a toast. False: it was not done.
    bool run(std::string_view word, const std::vector<std::string>& arguments = {});
    bool run_line(const std::string& line);
    // Opens the palette with this row, which waits for its arguments.
    void ask(const Command& command);
    void say(std::string text, bool fault = false);

    // Whether the player has this row: what it lacks is not shown.
    static bool has(std::string_view word) { return find_command(word) != nullptr; }
    bool open(std::string_view panel) const;
    void toggle(std::string_view panel);
    void show(std::string_view panel);  // opens it and brings it to the front of its area

    const PlayerState& state() const { return player.state(); }

    Player& player;
    const Theme& theme;
    Layout& layout;
    Toast toast;
    std::string to_front;  // a panel that was asked for
    std::string dragged;   // the parameter whose control the mouse holds, once it has changed
    std::string palette;   // what the palette is to begin with; "" as it is

  private:
    bool told(const CommandResult& result);
};

// "12", "12.5": as short as it can be.
std::string short_number(double value);

// A push button of the theme's accent, where it is on.
bool toggle_button(const Theme& theme, const char* label, bool on, const char* help);
// The help of the row, with its key, over the last item.
void command_tooltip(std::string_view word);
// A quiet line in an empty panel.
void empty_note(const Theme& theme, const char* text);

}  // namespace kinora::play
