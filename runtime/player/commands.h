// runtime/player/commands.h: the player's actions, one row each. Keys, menu entries, script words
// and the window's panels all go through Player::run with a row's word; nothing else changes the
// state.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kinora {

// What a command changes, as Player::observe() tells it.
enum class Observable : uint8_t {
    Camera,     // place, direction, optics, the scene camera chosen, its lock
    Time,       // the frame shown
    Playback,   // playing, direction, speed, loop, range, clip
    Picture,    // size, exposure, tone, AOV, false color, quality, wipe
    Selection,  // node, material, pixel
    Shader,     // the text under the caret, its parameters
    Scene,      // what is shown: edits, files opened
    Panels,     // which panels are open
    File,       // something was written: the number of files so far
    Quit,       // the player ends
};

struct ObservableRow {
    std::string_view name;  // in scripts and in the file that `state` writes
    Observable what;
};
std::span<const ObservableRow> observables();

struct Command {
    const char* word;       // "orbit"
    const char* key;        // "Shift+Left"; several parted by spaces; "" none
    const char* menu;       // "View/Orbit"; "" in no menu
    const char* arguments;  // "degrees:number degrees:number"; "[...]" may be left out
    const char* example;    // arguments that change the observable; $TMP is the tests' folder
    const char* setup;      // script lines before the example, parted by ';'
    Observable changes;
    const char* help;  // one sentence
};

std::span<const Command> commands();
const Command* find_command(std::string_view word);        // null: no such row
const Command* find_command_of_key(std::string_view key);  // "Ctrl+S", as SDL names keys

// The tables of docs/play.md: a line a row (scripts/docs).
std::string commands_markdown();

struct CommandResult {
    bool done = true;
    std::string message;  // why not, or what was found; "" nothing to say
    size_t argument = 0;  // where `done` is false: the argument at fault, from 1; 0 the word itself
};

// A script line in words: parted by spaces, "quoted texts" with \" \\ \n \t. Their columns, from 1.
struct Words {
    std::vector<std::string> texts;
    std::vector<int> columns;
    std::string error;  // an unfinished quotation
};
Words split_words(std::string_view line);
// A word as split_words() reads it.
std::string quoted(const std::string& text);

}  // namespace kinora
