// rsl/text/directives.cpp: what each '#' line does.
#include "rsl/text/directives.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rsl/text/did_you_mean.h"

namespace kinora::rsl {

const Directives::Row Directives::kRows[] = {
    {"define", false, false, &Directives::run_define},
    {"undef", false, false, &Directives::run_undef},
    {"include", false, false, &Directives::run_include},
    {"pragma", false, true, &Directives::run_pragma},
    {"error", false, true, &Directives::run_error},
    {"line", false, true, &Directives::run_nothing},
    {"ident", false, true, &Directives::run_nothing},
    {"sccs", false, true, &Directives::run_nothing},
    {"warning", false, true, &Directives::run_warning},
    {"if", true, false, &Directives::run_if},
    {"ifdef", true, false, &Directives::run_ifdef},
    {"ifndef", true, false, &Directives::run_ifndef},
    {"elif", true, false, &Directives::run_elif},
    {"else", true, false, &Directives::run_else},
    {"endif", true, false, &Directives::run_endif},
};

TokenList Directives::line_tokens() {
    TokenList line;
    for (Token t = files_.peek(); !t.line_start && t.kind != TokenKind::End; t = files_.peek())
        line.push_back(files_.next());
    return line;
}

void Directives::obey() {
    Token name = files_.peek();
    if (name.line_start || name.kind == TokenKind::End) return;  // a '#' alone means nothing
    name = files_.next();
    if (name.kind == TokenKind::Number) {  // "# 12 file": a line marker of another preprocessor
        line_tokens();
        return;
    }
    for (const Row& row : kRows) {
        if (row.name != name.text) continue;
        if (files_.skipping() && !row.conditional) {
            line_tokens();
            return;
        }
        (this->*row.run)(name, row.text_line ? TokenList{} : line_tokens());
        return;
    }
    if (!files_.skipping()) unknown(name);
    line_tokens();
}

void Directives::unknown(const Token& name) {
    std::vector<std::string_view> names;
    for (const Row& row : kRows) names.push_back(row.name);
    Finding& finding = reporter_.report(Code::RSL_UNKNOWN_DIRECTIVE, name, name.text);
    std::string_view near = nearest_name(name.text, names);
    if (!near.empty()) finding.help = fmt::format("did you mean '#{}'?", near);
}

void Directives::run_define(const Token& name, Line line) {
    std::optional<Macro> macro = read_macro(name, line, reporter_);
    if (!macro) return;
    macro->standard = files_.in_standard_header();
    macros_.define(std::move(*macro));
}

void Directives::run_undef(const Token& name, Line line) {
    if (line.empty() || line[0].kind != TokenKind::Identifier)
        reporter_.report(Code::RSL_BAD_DIRECTIVE, name, "undef", "a macro name");
    else
        macros_.undefine(line[0].text);
}

// ---- include ------------------------------------------------------------------------------------

void Directives::run_include(const Token& name, Line line) {
    TokenList tokens = line;
    if (!tokens.empty() && tokens[0].kind == TokenKind::Identifier)
        tokens = expander_.expand(tokens);
    std::string file;
    if (!tokens.empty() && tokens[0].kind == TokenKind::String && tokens[0].text.size() > 1) {
        file = tokens[0].text.substr(1, tokens[0].text.size() - 2);
        text_behind(tokens, 1);
        include(file, true, tokens[0]);
        return;
    }
    if (tokens.empty() || tokens[0].punct != Punct::Less) {
        reporter_.report(Code::RSL_BAD_DIRECTIVE, name, "include", "\"file\" or <file>");
        return;
    }
    Token at = tokens[0];
    size_t i = 1;
    for (; i < tokens.size() && tokens[i].punct != Punct::Greater; ++i) {
        file += tokens[i].text;
        at.where.end = std::max(at.where.end, tokens[i].where.end);
    }
    text_behind(tokens, i + 1);
    include(file, false, at);
}

// What stands behind the file's name on its line belongs to no line of the source.
void Directives::text_behind(Line line, size_t first) {
    if (first >= line.size() || line[first].punct == Punct::Semicolon) return;
    reporter_.report(Code::RSL_TEXT_BEHIND_INCLUDE, line[first], line[first].text);
}

void Directives::include(const std::string& file, bool quoted, const Token& at) {
    if (!budget_.spend_include(files_.depth(), file, at)) return;
    std::optional<SourceText> text = includes_.find(file, quoted, files_.path(), at);
    if (text) files_.enter(std::move(*text));
}

// ---- conditions ---------------------------------------------------------------------------------

bool Directives::condition_value(const Token& name, Line line) {
    TokenList tokens = expander_.expand_condition(line);
    auto reported = [](const Token& token) { return token.lost; };
    if (std::any_of(tokens.begin(), tokens.end(), reported)) return false;
    return evaluate_condition(tokens, name, reporter_);
}

bool Directives::defined_argument(const Token& name, Line line) {
    if (!line.empty() && line[0].kind == TokenKind::Identifier)
        return macros_.is_defined(line[0].text);
    reporter_.report(Code::RSL_BAD_DIRECTIVE, name, name.text, "a macro name");
    return false;
}

void Directives::run_if(const Token& name, Line line) {
    files_.conditions().open(name.where, !files_.skipping() && condition_value(name, line));
}
void Directives::run_ifdef(const Token& name, Line line) {
    files_.conditions().open(name.where, !files_.skipping() && defined_argument(name, line));
}
void Directives::run_ifndef(const Token& name, Line line) {
    files_.conditions().open(name.where, !files_.skipping() && !defined_argument(name, line));
}

// The #if that an #elif, #else or #endif belongs to; null (and a finding) when there is none.
Condition* Directives::open_condition(const Token& name) {
    if (Condition* condition = files_.conditions().innermost()) return condition;
    reporter_.report(Code::RSL_STRAY_DIRECTIVE, name, name.text);
    return nullptr;
}

void Directives::run_elif(const Token& name, Line line) {
    Condition* condition = open_condition(name);
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

void Directives::run_else(const Token& name, Line) {
    Condition* condition = open_condition(name);
    if (!condition) return;
    if (condition->saw_else) reporter_.report(Code::RSL_STRAY_DIRECTIVE, name, name.text);
    condition->saw_else = true;
    condition->active = !condition->done;
    condition->done = true;
}

void Directives::run_endif(const Token& name, Line) {
    if (open_condition(name)) files_.conditions().close();
}

// ---- lines that keep their text -----------------------------------------------------------------

void Directives::run_pragma(const Token& name, Line) {
    std::string_view text = files_.rest_of_line();
    if (text.starts_with("once"))
        includes_.read_once(files_.path());
    else
        out_.pragmas.push_back({text, name.where});
}

void Directives::run_error(const Token& name, Line) {
    reporter_.report(Code::RSL_ERROR_DIRECTIVE, name, files_.rest_of_line());
}

void Directives::run_warning(const Token& name, Line) {
    reporter_.report(Code::RSL_WARNING_DIRECTIVE, name, files_.rest_of_line());
}

void Directives::run_nothing(const Token&, Line) {
    files_.rest_of_line();
}

}  // namespace kinora::rsl
