// rsl/text/token.h: the tokens of shader source after preprocessing, and where each one came from.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

enum class TokenKind : uint8_t { End, Identifier, Number, String, Punctuator, Other };

// Words with a meaning. Types, details and control words are reserved; the shader kinds and the
// block statements are words only where the grammar expects them, and else ordinary names.
enum class Word : uint8_t {
    None,
#define WORD(name, text) name,
#include "rsl/text/words.def"
#undef WORD
};

// Punctuators; Punct::Other is a character that no expression has.
enum class Punct : uint8_t {
    None,
#define PUNCT(name, text) name,
#include "rsl/text/puncts.def"
#undef PUNCT
    Other
};

struct Token {
    TokenKind kind = TokenKind::End;
    Punct punct = Punct::None;  // of a Punctuator
    Word word = Word::None;     // of an Identifier; set by preprocess()
    bool space_before = false;  // white space or a comment stands before it
    bool line_start = false;    // first of its line
    bool painted = false;       // preprocessor: names a macro inside its own expansion
    bool lost = false;          // stands for a macro use that was reported and dropped
    std::string_view text;      // spelling; of a String with its quotes
    Location where;             // in the user's file: for a token out of a macro, the macro's use
    Location spelling;          // where its letters stand: differs from `where` for macro tokens
    uint32_t macro = 0;         // TokenStream::macros of its expansion; 0 = not out of a macro
};

using TokenList = std::vector<Token>;

// One expansion of a macro.
struct MacroUse {
    std::string_view name;
    Location definition;
    uint32_t parent = 0;  // the expansion it stands in; 0 = the file's own text
};

struct PragmaToken {
    std::string_view text;
    Location where;
};

struct TokenStream {
    std::vector<Token> tokens;     // ends with an End token
    std::vector<MacroUse> macros;  // [0] is no macro
    std::vector<PragmaToken> pragmas;
    bool truncated = false;         // expansion or includes went over their limits
    std::deque<std::string> texts;  // what the tokens' views point into
};

}  // namespace kinora::rsl
