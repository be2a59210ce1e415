// rsl/text/preprocess_directives.cpp: the '#' lines.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "rsl/text/preprocess.h"
#include "rsl/text/standard_headers.h"
#include "runtime/base/text_encoding.h"

namespace kinora::rsl {

const Preprocessor::DirectiveRow Preprocessor::kDirectives[] = {
    {"define", false, &Preprocessor::run_define},   {"undef", false, &Preprocessor::run_undef},
    {"include", false, &Preprocessor::run_include}, {"pragma", false, &Preprocessor::run_pragma},
    {"error", false, &Preprocessor::run_error},     {"line", false, &Preprocessor::run_nothing},
    {"ident", false, &Preprocessor::run_nothing},   {"sccs", false, &Preprocessor::run_nothing},
    {"warning", false, &Preprocessor::run_warning}, {"if", true, &Preprocessor::run_if},
    {"ifdef", true, &Preprocessor::run_ifdef},      {"ifndef", true, &Preprocessor::run_ifndef},
    {"elif", true, &Preprocessor::run_elif},        {"else", true, &Preprocessor::run_else},
    {"endif", true, &Preprocessor::run_endif},
};

Preprocessor::TokenList Preprocessor::directive_tokens() {
    TokenList line;
    for (Token t = peek_raw(); !t.line_start && t.kind != TokenKind::End; t = peek_raw())
        line.push_back(raw_next());
    return line;
}

// The '#' has been read. Leaves the lexer at the next line.
void Preprocessor::directive() {
    Token name = peek_raw();
    if (name.line_start || name.kind == TokenKind::End) return;  // a '#' alone means nothing
    name = raw_next();
    if (name.kind == TokenKind::Number) {  // "# 12 file": a line marker of another preprocessor
        directive_tokens();
        return;
    }
    for (const DirectiveRow& row : kDirectives) {
        if (row.name != name.text) continue;
        if (skipping() && !row.conditional) {
            directive_tokens();
            return;
        }
        bool text_line =
            row.run == &Preprocessor::run_pragma || row.run == &Preprocessor::run_error ||
            row.run == &Preprocessor::run_warning || row.run == &Preprocessor::run_nothing;
        (this->*row.run)(name, text_line ? TokenList{} : directive_tokens());
        return;
    }
    if (!skipping()) {
        std::vector<std::string_view> names;
        for (const DirectiveRow& row : kDirectives) names.push_back(row.name);
        Finding& finding = reporter_.report(Code::RSL_UNKNOWN_DIRECTIVE, name, name.text);
        std::string_view near = nearest_name(name.text, names);
        if (!near.empty()) finding.help = fmt::format("did you mean '#{}'?", near);
    }
    directive_tokens();
}

bool Preprocessor::is_defined(std::string_view name) const {
    auto found = macros_.find(name);
    return found != macros_.end() && !found->second.undefined;
}

void Preprocessor::run_define(const Token& name, Line line) {
    if (line.empty() || line[0].kind != TokenKind::Identifier) {
        reporter_.report(Code::RSL_BAD_DIRECTIVE, line.empty() ? name : line[0], "define",
                         "a macro name");
        return;
    }
    Macro macro;
    macro.name = line[0].text;
    macro.definition = line[0].where;
    macro.standard = !files_.empty() && files_.back().standard;
    size_t next = 1;
    bool opens = line.size() > 1 && line[1].punct == Punct::LeftParen && !line[1].space_before;
    if (opens && !define_parameters(macro, line, next)) return;
    macro.replacement.assign(line.begin() + long(next), line.end());
    macros_.insert_or_assign(macro.name, std::move(macro));
}

// Reads "(a, b)"; next = 1 at entry, behind the ')' at exit.
bool Preprocessor::define_parameters(Macro& macro, Line line, size_t& next) {
    macro.function_like = true;
    ++next;
    bool want_name = true;
    for (; next < line.size(); ++next) {
        const Token& token = line[next];
        if (token.punct == Punct::RightParen) {
            ++next;
            return true;
        }
        if (want_name && token.kind == TokenKind::Identifier) {
            macro.parameters.push_back(token.text);
            for (; next + 1 < line.size() && line[next + 1].punct == Punct::Dot; ++next)
                macro.variadic = true;                        // "rest..."
        } else if (want_name && token.punct == Punct::Dot) {  // "..." comes as three
            macro.variadic = true;
            while (next + 1 < line.size() && line[next + 1].punct == Punct::Dot) ++next;
            macro.parameters.push_back("__VA_ARGS__");
        } else if (want_name || token.punct != Punct::Comma) {
            reporter_.report(Code::RSL_BAD_DIRECTIVE, token, "define", "a parameter name");
            return false;
        }
        want_name = !want_name;
    }
    reporter_.report(Code::RSL_BAD_DIRECTIVE, line.back(), "define", "')'");
    return false;
}

void Preprocessor::run_undef(const Token& name, Line line) {
    if (line.empty() || line[0].kind != TokenKind::Identifier) {
        reporter_.report(Code::RSL_BAD_DIRECTIVE, name, "undef", "a macro name");
        return;
    }
    auto found = macros_.find(line[0].text);
    if (found != macros_.end()) found->second.undefined = true;
}

// ---- include ------------------------------------------------------------------------------------

void Preprocessor::run_include(const Token& name, Line line) {
    TokenList tokens = line;
    if (!tokens.empty() && tokens[0].kind == TokenKind::Identifier) tokens = expand_list(tokens);
    std::string file;
    if (!tokens.empty() && tokens[0].kind == TokenKind::String && tokens[0].text.size() > 1) {
        file = tokens[0].text.substr(1, tokens[0].text.size() - 2);
        load_include(file, true, tokens[0]);
        return;
    }
    if (tokens.empty() || tokens[0].punct != Punct::Less) {
        reporter_.report(Code::RSL_BAD_DIRECTIVE, name, "include", "\"file\" or <file>");
        return;
    }
    Token at = tokens[0];
    for (size_t i = 1; i < tokens.size() && tokens[i].punct != Punct::Greater; ++i) {
        file += tokens[i].text;
        at.where.end = std::max(at.where.end, tokens[i].where.end);
    }
    load_include(file, false, at);
}

namespace {

bool same_letters(std::string_view a, std::string_view b) {
    auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

// The file of that name in whatever letter case, as systems find it whose names have none.
std::filesystem::path in_any_case(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::exists(path, error)) return path;
    std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::filesystem::path best;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        bool same = same_letters(entry.path().filename().string(), path.filename().string());
        if (same && (best.empty() || entry.path() < best)) best = entry.path();
    }
    return best.empty() ? path : best;
}

bool read_whole_file(const std::filesystem::path& path, std::string& text) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;
    if (std::filesystem::file_size(path, error) > kMostIncludeBytes || error) return false;
    std::ifstream in(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
    return bool(in) || in.eof();
}

}  // namespace

bool Preprocessor::load_include(std::string file, bool quoted, const Token& at) {
    if (files_.size() > kMostIncludeDepth || ++includes_ > kMostIncludes) {
        reporter_.report(Code::RSL_INCLUDE_TOO_DEEP, at, file);
        exhausted_ = out_.truncated = true;
        return false;
    }
    std::replace(file.begin(), file.end(), '\\', '/');  // as written on Windows
    std::vector<std::filesystem::path> folders;
    if (quoted) folders.push_back(std::filesystem::path(files_.back().path).parent_path());
    for (const std::string& directory : options_.include_directories) folders.push_back(directory);
    if (!quoted) folders.push_back(std::filesystem::path(files_.back().path).parent_path());
    bool outside = false;
    for (const std::filesystem::path& folder : folders) {
        std::filesystem::path path = in_any_case(folder / file);
        std::string text;
        if (!options_.files.contains(path.string())) {
            outside = true;
            continue;
        }
        if (!read_whole_file(path, text)) continue;
        text = utf8_text(std::move(text));
        std::string key = path.lexically_normal().string();
        if (std::find(once_.begin(), once_.end(), key) != once_.end()) return true;
        maps_.emplace_back();
        maps_.back().file = diagnostics_.files.add(path.string(), text);
        enter_text(keep(std::move(text)), maps_.back(), std::move(key));
        return true;
    }
    if (std::string_view text = standard_header(file); !text.empty()) {
        maps_.emplace_back();
        maps_.back().file = diagnostics_.files.add("include/" + file, std::string(text));
        enter_text(text, maps_.back(), file);
        files_.back().standard = true;
        return true;
    }
    reporter_.report(outside ? Code::RSL_INCLUDE_OUTSIDE : Code::RSL_INCLUDE_NOT_FOUND, at, file);
    return false;
}

// ---- conditions ---------------------------------------------------------------------------------

void Preprocessor::open_condition(const Token& name, bool value) {
    bool outer = !skipping();
    conditions_.push_back({name.where, outer && value, !outer || value, false});
}

bool Preprocessor::condition_value(const Token& name, Line line) {
    in_condition_ = true;
    TokenList tokens = expand_list(line);
    in_condition_ = false;
    auto reported = [](const Token& token) { return token.lost; };
    if (std::any_of(tokens.begin(), tokens.end(), reported)) return false;
    return evaluate_condition(tokens, name, reporter_);
}

// "defined NAME" or "defined(NAME)", of the line or of a macro that it names, as other
// preprocessors take it (C11 6.10.1 leaves the latter open).
Token Preprocessor::defined_operator(Token token) {
    bool open = peek_unexpanded().punct == Punct::LeftParen;
    if (open) next_unexpanded();
    Token name = peek_unexpanded();
    bool named = name.kind == TokenKind::Identifier;
    if (named)
        next_unexpanded();
    else
        reporter_.report(Code::RSL_BAD_DIRECTIVE, token, "if defined", "a macro name");
    token.lost = !named;
    if (open && peek_unexpanded().punct == Punct::RightParen) next_unexpanded();
    token.kind = TokenKind::Number;
    token.text = named && is_defined(name.text) ? "1" : "0";
    return token;
}

bool Preprocessor::defined_argument(const Token& name, Line line) {
    if (!line.empty() && line[0].kind == TokenKind::Identifier) return is_defined(line[0].text);
    reporter_.report(Code::RSL_BAD_DIRECTIVE, name, name.text, "a macro name");
    return false;
}

void Preprocessor::run_if(const Token& name, Line line) {
    open_condition(name, !skipping() && condition_value(name, line));
}
void Preprocessor::run_ifdef(const Token& name, Line line) {
    open_condition(name, !skipping() && defined_argument(name, line));
}
void Preprocessor::run_ifndef(const Token& name, Line line) {
    open_condition(name, !skipping() && !defined_argument(name, line));
}

// The #if that an #elif, #else or #endif belongs to; null (and a finding) when there is none.
Preprocessor::Condition* Preprocessor::inner_condition(const Token& name) {
    if (conditions_.size() > files_.back().conditions) return &conditions_.back();
    reporter_.report(Code::RSL_STRAY_DIRECTIVE, name, name.text);
    return nullptr;
}

void Preprocessor::run_elif(const Token& name, Line line) {
    Condition* condition = inner_condition(name);
    if (!condition) return;
    if (condition->saw_else) reporter_.report(Code::RSL_STRAY_DIRECTIVE, name, name.text);
    if (condition->done) {
        condition->active = false;
        return;
    }
    condition->active = true;  // the expression belongs to the text around the #if
    bool value = condition_value(name, line);
    condition->active = condition->done = value;
}

void Preprocessor::run_else(const Token& name, Line) {
    Condition* condition = inner_condition(name);
    if (!condition) return;
    if (condition->saw_else) reporter_.report(Code::RSL_STRAY_DIRECTIVE, name, name.text);
    condition->saw_else = true;
    condition->active = !condition->done;
    condition->done = true;
}

void Preprocessor::run_endif(const Token& name, Line) {
    if (inner_condition(name)) conditions_.pop_back();
}

// ---- lines that keep their text -----------------------------------------------------------------

void Preprocessor::run_pragma(const Token& name, Line) {
    std::string_view text = files_.back().lexer.rest_of_line();
    if (text.starts_with("once"))
        once_.push_back(std::filesystem::path(files_.back().path).lexically_normal().string());
    else
        out_.pragmas.push_back({text, name.where});
}

void Preprocessor::run_error(const Token& name, Line) {
    reporter_.report(Code::RSL_ERROR_DIRECTIVE, name, files_.back().lexer.rest_of_line());
}

void Preprocessor::run_warning(const Token& name, Line) {
    reporter_.report(Code::RSL_WARNING_DIRECTIVE, name, files_.back().lexer.rest_of_line());
}

void Preprocessor::run_nothing(const Token&, Line) {
    files_.back().lexer.rest_of_line();
}

}  // namespace kinora::rsl
