// rsl/text/preprocess.cpp: the reading of files: text lines pass through, macros expand, '#' lines
// are directives.
#include "rsl/text/preprocess.h"

#include <fmt/format.h>

#include <utility>

namespace kinora::rsl {

Preprocessor::Preprocessor(const CompileOptions& options, Diagnostics& diagnostics,
                           TokenStream& out, Reporter& reporter)
    : options_(options), diagnostics_(diagnostics), out_(out), reporter_(reporter) {
    if (out_.macros.empty()) out_.macros.push_back({});
}

std::string_view Preprocessor::keep(std::string text) {
    out_.texts.push_back(std::move(text));
    return out_.texts.back();
}

Preprocessor::TokenList Preprocessor::text_tokens(std::string text) {
    maps_.emplace_back();
    Lexer lexer(keep(std::move(text)), maps_.back());
    TokenList tokens;
    for (Token token = lexer.next(); token.kind != TokenKind::End; token = lexer.next()) {
        token.spelling = {};
        tokens.push_back(token);
    }
    return tokens;
}

// As "#define NAME VALUE", where NAME may have parameters.
void Preprocessor::define_text(std::string_view name, std::string_view value) {
    TokenList line = text_tokens(fmt::format("{} {}", name, value));
    Token define;
    define.text = "define";
    run_define(define, line);
}

void Preprocessor::define_from_options() {
    for (const char* name : {"__FILE__", "__LINE__"}) {
        Macro macro;
        macro.name = name;
        macro.special = true;
        macros_.emplace(macro.name, std::move(macro));
    }
    define_text("KINORA", "1");
    // What C gives where it does not know the time: the same source gives the same code.
    define_text("__DATE__", "\"??? ?? ????\"");
    define_text("__TIME__", "\"??:??:??\"");
    for (const auto& [name, value] : options_.defines) define_text(name, value);
    for (const std::string& name : options_.undefines) macros_.erase(std::string_view(name));
}

void Preprocessor::enter_text(std::string_view text, const SourceMap& map, std::string path) {
    files_.push_back({Lexer(text, map), map.file, std::move(path), conditions_.size()});
}

void Preprocessor::run(const ShaderSource& source) {
    define_from_options();
    maps_.push_back(source.map);
    std::string path;
    if (source.map.file != kNoFile) path = diagnostics_.files.name(source.map.file);
    enter_text(keep(std::string(source.text)), maps_.back(), std::move(path));
    out_.tokens.reserve(source.text.size() / 4 + 16);
    read_file();
}

void Preprocessor::report_trouble() {
    Location where;
    switch (files_.back().lexer.take_trouble(where)) {
        case Lexer::Trouble::None:
            break;
        case Lexer::Trouble::UnterminatedString:
            reporter_.report(Code::RSL_UNTERMINATED_STRING, where, 0, {});
            break;
        case Lexer::Trouble::UnterminatedComment:
            reporter_.report(Code::RSL_UNTERMINATED_COMMENT, where, 0, {});
            break;
    }
}

Token Preprocessor::raw_next() {
    Token token = files_.back().lexer.next();
    Location ignored;
    if (skipping())
        files_.back().lexer.take_trouble(ignored);
    else
        report_trouble();
    return token;
}

Token Preprocessor::peek_raw() {
    Lexer ahead = files_.back().lexer;
    return ahead.next();
}

void Preprocessor::emit(Token token) {
    if (token.kind == TokenKind::Identifier) token.word = find_word(token.text);
    out_.tokens.push_back(token);
}

// Ends the innermost file: its open #if are errors.
void Preprocessor::finish_file() {
    while (conditions_.size() > files_.back().conditions) {
        reporter_.report(Code::RSL_UNTERMINATED_IF, conditions_.back().where, 0, {});
        conditions_.pop_back();
    }
    files_.pop_back();
}

void Preprocessor::read_file() {
    Token token;
    while (true) {
        token = next_expanded();
        if (exhausted_ || reporter_.full()) break;
        if (token.kind != TokenKind::End) {
            if (token.punct == Punct::Hash && token.line_start && token.macro == 0)
                directive();
            else if (!skipping())
                emit(token);
            continue;
        }
        if (files_.size() == 1) break;
        finish_file();
    }
    while (!files_.empty()) {
        if (files_.size() == 1) token = raw_next();
        finish_file();
    }
    Token end;
    end.where = end.spelling = token.where;
    end.line_start = true;
    out_.tokens.push_back(end);
}

}  // namespace kinora::rsl
