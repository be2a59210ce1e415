// rsl/text/text_store.cpp: tokens of texts that stand in no file.
#include "rsl/text/text_store.h"

#include "rsl/text/lexer.h"

namespace kinora::rsl {

TokenList TextStore::tokens_of(std::string text) {
    Lexer lexer(keep(std::move(text)), keep(SourceMap{}));
    TokenList tokens;
    for (Token token = lexer.next(); token.kind != TokenKind::End; token = lexer.next()) {
        token.spelling = {};
        tokens.push_back(token);
    }
    return tokens;
}

}  // namespace kinora::rsl
