// rsl/token.h: the tokens of shader source after preprocessing, and where each one came from.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

enum class TokenKind : uint8_t { End, Identifier, Number, String, Punctuator, Other };

struct Token {
    TokenKind kind = TokenKind::End;
    bool space_before = false;  // white space or a comment stands before it
    bool line_start = false;    // first of its line
    std::string_view text;      // spelling; of a String with its quotes
    Location where;             // in the user's file: for a token out of a macro, the macro's use
    Location spelling;          // where its letters stand: differs from `where` for macro tokens
    uint32_t macro = 0;         // TokenStream::macros of its expansion; 0 = not out of a macro
};

// One expansion of a macro.
struct MacroUse {
    std::string_view name;
    Location definition;
    uint32_t parent = 0;  // the expansion it stands in; 0 = the file's own text
};

struct TokenStream {
    std::vector<Token> tokens;      // ends with an End token
    std::vector<MacroUse> macros;   // [0] is no macro
    std::deque<std::string> texts;  // what the tokens' views point into
};

}  // namespace kinora::rsl
