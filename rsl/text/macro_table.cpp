// rsl/text/macro_table.cpp: definitions of macros.
#include "rsl/text/macro_table.h"

namespace kinora::rsl {

void MacroTable::define(Macro macro) {
    macros_.insert_or_assign(macro.name, std::move(macro));
}

void MacroTable::undefine(std::string_view name) {
    if (Macro* macro = find(name)) macro->undefined = true;
}

Macro* MacroTable::find(std::string_view name) {
    auto found = macros_.find(name);
    return found == macros_.end() || found->second.undefined ? nullptr : &found->second;
}

namespace {

// Reads "(a, b)"; next = 1 at entry, behind the ')' at exit.
bool read_parameters(Macro& macro, const TokenList& line, size_t& next, Reporter& reporter) {
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
            reporter.report(Code::RSL_BAD_DIRECTIVE, token, "define", "a parameter name");
            return false;
        }
        want_name = !want_name;
    }
    reporter.report(Code::RSL_BAD_DIRECTIVE, line.back(), "define", "')'");
    return false;
}

}  // namespace

std::optional<Macro> read_macro(const Token& directive, const TokenList& line, Reporter& reporter) {
    if (line.empty() || line[0].kind != TokenKind::Identifier) {
        reporter.report(Code::RSL_BAD_DIRECTIVE, line.empty() ? directive : line[0], "define",
                        "a macro name");
        return std::nullopt;
    }
    Macro macro;
    macro.name = line[0].text;
    macro.definition = line[0].where;
    size_t next = 1;
    bool opens = line.size() > 1 && line[1].punct == Punct::LeftParen && !line[1].space_before;
    if (opens && !read_parameters(macro, line, next, reporter)) return std::nullopt;
    macro.replacement.assign(line.begin() + long(next), line.end());
    return macro;
}

}  // namespace kinora::rsl
