// runtime/programs/play/editor/language.cpp: from the lexer and the tables of the language.
#include "runtime/programs/play/editor/language.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "rsl/builtins/table.h"
#include "rsl/model/globals.h"
#include "rsl/text/lexer.h"
#include "runtime/programs/manual/rows.h"
#include "runtime/programs/manual/statements.h"

namespace kinora::play {

namespace {

bool is_type(rsl::Word word) {
    return word >= rsl::Word::Float && word <= rsl::Word::Void;
}

bool is_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

Ink ink_of(const rsl::Token& token) {
    switch (token.kind) {
        case rsl::TokenKind::Number:
            return Ink::Number;
        case rsl::TokenKind::String:
            return Ink::String;
        case rsl::TokenKind::Identifier: {
            const rsl::Word word = rsl::find_word(token.text);
            if (is_type(word)) return Ink::Type;
            if (word != rsl::Word::None) return Ink::Keyword;
            if (rsl::find_global(token.text)) return Ink::Global;
            return rsl::find_builtin(token.text).empty() ? Ink::Plain : Ink::Builtin;
        }
        case rsl::TokenKind::End:
        case rsl::TokenKind::Punctuator:
        case rsl::TokenKind::Other:
            break;
    }
    return Ink::Plain;
}

// Between two tokens stand blanks and comments.
void add_comment(std::vector<InkRun>& runs, std::string_view text, size_t begin, size_t end) {
    while (begin < end && std::isspace(static_cast<unsigned char>(text[begin]))) ++begin;
    while (end > begin && std::isspace(static_cast<unsigned char>(text[end - 1]))) --end;
    if (begin < end) runs.push_back({begin, end, Ink::Comment});
}

std::string form_of(const rsl::Builtin& row) {
    const auto forms = builtin_forms(row);
    return forms.empty() ? std::string() : forms.front().line();
}

class Names {
  public:
    explicit Names(std::string_view prefix) : prefix_(prefix) {}

    void offer(std::string_view name, Ink ink, std::string form = {}) {
        if (name.size() <= prefix_.size() || !name.starts_with(prefix_)) return;
        if (seen_.emplace(name).second) found_.push_back({std::string(name), ink, std::move(form)});
    }

    std::vector<Completion> take() {
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Completion& a, const Completion& b) {
                             return a.name.size() != b.name.size() ? a.name.size() < b.name.size()
                                                                   : a.name < b.name;
                         });
        return std::move(found_);
    }

  private:
    std::string_view prefix_;
    std::set<std::string, std::less<>> seen_;
    std::vector<Completion> found_;
};

}  // namespace

std::vector<InkRun> color_runs(std::string_view text) {
    const SourceMap map;
    rsl::Lexer lexer(text, map);
    std::vector<InkRun> runs;
    size_t reached = 0;
    while (true) {
        const rsl::Token token = lexer.next();
        const size_t begin = token.kind == rsl::TokenKind::End ? text.size() : token.where.begin;
        add_comment(runs, text, reached, begin);
        if (token.kind == rsl::TokenKind::End) return runs;
        reached = token.where.end;
        if (token.line_start && token.text == "#") {
            lexer.rest_of_line();
            reached = std::min<size_t>(lexer.here().begin, text.size());
            while (reached > begin && std::isspace(static_cast<unsigned char>(text[reached - 1])))
                --reached;
            runs.push_back({begin, reached, Ink::Directive});
            continue;
        }
        runs.push_back({begin, reached, ink_of(token)});
    }
}

WordRange word_at(std::string_view text, size_t at) {
    WordRange word{at, at};
    while (word.begin > 0 && is_letter(text[word.begin - 1])) --word.begin;
    while (word.end < text.size() && is_letter(text[word.end])) ++word.end;
    if (word.begin < word.end && std::isdigit(static_cast<unsigned char>(text[word.begin])))
        return {at, at};
    return word;
}

std::vector<Completion> completions(std::string_view text, size_t caret, size_t least) {
    const WordRange word = word_at(text, caret);
    if (caret - word.begin < least || word.end != caret) return {};
    Names names(text.substr(word.begin, caret - word.begin));
    for (const rsl::BuiltinGroup& group : rsl::builtin_groups())
        for (const rsl::Builtin& row : group)
            if (!(row.effects & rsl::kForHeaders))
                names.offer(row.name, Ink::Builtin, form_of(row));
    for (const rsl::GlobalInfo& global : rsl::globals())
        names.offer(global.name, Ink::Global, manual_line(global.name).form);
    for (int i = static_cast<int>(rsl::Word::Float); i <= static_cast<int>(rsl::Word::Deformation);
         ++i) {
        const auto kind = static_cast<rsl::Word>(i);
        names.offer(rsl::word_text(kind), is_type(kind) ? Ink::Type : Ink::Keyword);
    }
    for (const InkRun& run : color_runs(text))
        if (run.ink == Ink::Plain && is_letter(text[run.begin]) && run.begin != word.begin)
            names.offer(text.substr(run.begin, run.end - run.begin), Ink::Plain);
    return names.take();
}

ManualLine manual_line(std::string_view name) {
    if (const rsl::GlobalInfo* global = rsl::find_global(name))
        return {rsl::type_name(global->type) + " " + std::string(name), global->doc};
    if (const auto overloads = rsl::find_builtin(name); !overloads.empty()) {
        const rsl::Builtin& row = *overloads.front().builtin;
        return {form_of(row), row.doc};
    }
    for (const ManualChapter& chapter : manual_chapters())
        for (const ManualEntry& entry : chapter.entries)
            if (entry.has_name(name)) return {std::string(entry.form), std::string(entry.text)};
    return {};
}

}  // namespace kinora::play
