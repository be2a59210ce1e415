// runtime/programs/play/editor/language.h: what the editor knows of RSL: colours of words, names to
// complete, the manual's line. All of it comes from the compiler's own lexer and tables.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinora::play {

enum class Ink : uint8_t {
    Plain,
    Comment,
    Directive,  // a line of the preprocessor
    Keyword,    // if, surface, uniform
    Type,       // float, color
    Builtin,    // noise, diffuse
    Global,     // P, Ci
    Number,
    String,
    Count,
};

// A run of bytes of one colour; runs cover what is not blank, in order.
struct InkRun {
    size_t begin, end;
    Ink ink;
};
std::vector<InkRun> color_runs(std::string_view text);

struct Completion {
    std::string name;
    Ink ink = Ink::Plain;
    std::string form;  // "float noise(float, float)"; "" a name of this text
};
// What begins with the word that ends at the caret: names of the language and of the text itself,
// the nearest in length first. Nothing where fewer than `least` letters stand.
std::vector<Completion> completions(std::string_view text, size_t caret, size_t least);

// The bytes of the word at or just before an offset; empty if there is none.
struct WordRange {
    size_t begin = 0, end = 0;
};
WordRange word_at(std::string_view text, size_t at);

// What the manual says of a name: its form and one line. Both are empty for other names.
struct ManualLine {
    std::string form, text;
};
ManualLine manual_line(std::string_view name);

}  // namespace kinora::play
