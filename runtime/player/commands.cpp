// runtime/player/commands.cpp: the table of commands, and a line's words.
#include "runtime/player/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace kinora {

namespace {

constexpr Command kCommands[] = {
#define COMMAND(word, key, menu, arguments, example, setup, changes, help) \
    {#word, key, menu, arguments, example, setup, Observable::changes, help},
#include "runtime/player/commands.def"
#undef COMMAND
};

constexpr ObservableRow kObservables[] = {
    {"camera", Observable::Camera},       {"time", Observable::Time},
    {"playback", Observable::Playback},   {"picture", Observable::Picture},
    {"selection", Observable::Selection}, {"shader", Observable::Shader},
    {"scene", Observable::Scene},         {"panels", Observable::Panels},
    {"files", Observable::File},          {"quit", Observable::Quit},
};

bool has_key(std::string_view keys, std::string_view key) {
    while (!keys.empty()) {
        size_t end = std::min(keys.find(' '), keys.size());
        if (keys.substr(0, end) == key) return true;
        keys.remove_prefix(std::min(end + 1, keys.size()));
    }
    return false;
}

std::string subject_markdown(std::string_view title, std::string_view note) {
    return fmt::format("\n**{}.**{}{}\n\n| command | keys | what it does |\n|---|---|---|\n", title,
                       note.empty() ? "" : " ", note);
}

// "orbit right up" of "right:number up:number".
std::string words_of(const Command& command) {
    std::string words = command.word;
    for (std::string& argument : split_words(command.arguments).texts) {
        size_t colon = argument.find(':');
        words += ' ' + argument.substr(0, colon) + (argument.ends_with(']') ? "]" : "");
    }
    return words;
}

std::string command_markdown(const Command& command) {
    std::string keys;
    for (const std::string& key : split_words(command.key).texts)
        keys += fmt::format("{}`{}`", keys.empty() ? "" : " ", key);
    return fmt::format("| `{}` | {} | {} |\n", words_of(command), keys, command.help);
}

// The character of an escape in a quoted text.
char escaped(char c) {
    return c == 'n' ? '\n' : c == 't' ? '\t' : c;
}

}  // namespace

std::span<const Command> commands() {
    return kCommands;
}

std::span<const ObservableRow> observables() {
    return kObservables;
}

const Command* find_command(std::string_view word) {
    auto found = std::ranges::find_if(kCommands, [&](const Command& c) { return word == c.word; });
    return found == std::end(kCommands) ? nullptr : found;
}

const Command* find_command_of_key(std::string_view key) {
    auto found =
        std::ranges::find_if(kCommands, [&](const Command& c) { return has_key(c.key, key); });
    return found == std::end(kCommands) ? nullptr : found;
}

std::string commands_markdown() {
    std::string text;
#define SUBJECT(title, note) text += subject_markdown(title, note);
#define COMMAND(word, ...) text += command_markdown(*find_command(#word));
#include "runtime/player/commands.def"
#undef COMMAND
    return text.substr(1);
}

std::string quoted(const std::string& text) {
    bool plain = !text.empty() && text.find_first_of(" \t\n\"\\#") == text.npos;
    if (plain) return text;
    std::string out = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c == '\n' ? std::string("\\n") : c == '\t' ? std::string("\\t") : std::string(1, c);
    }
    return out + "\"";
}

Words split_words(std::string_view line) {
    Words words;
    size_t at = 0;
    while (true) {
        while (at < line.size() && std::isspace(static_cast<unsigned char>(line[at]))) ++at;
        if (at == line.size() || line[at] == '#') return words;
        words.columns.push_back(int(at) + 1);
        std::string& word = words.texts.emplace_back();
        if (line[at] != '"') {
            while (at < line.size() && !std::isspace(static_cast<unsigned char>(line[at])))
                word += line[at++];
            continue;
        }
        ++at;
        while (at < line.size() && line[at] != '"') {
            if (line[at] == '\\' && at + 1 < line.size())
                word += escaped(line[++at]);
            else
                word += line[at];
            ++at;
        }
        if (at == line.size()) {
            words.error = "the quotation does not end";
            return words;
        }
        ++at;
    }
}

}  // namespace kinora
