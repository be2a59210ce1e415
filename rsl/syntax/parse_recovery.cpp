// rsl/syntax/recovery.cpp: the names that skipped text may declare.
#include "rsl/syntax/parse_recovery.h"

#include <algorithm>
#include <utility>

namespace kinora::rsl {

namespace {

bool is_type(const Token& token) {
    return token.word >= Word::Float && token.word <= Word::Output;
}

bool ends_statement(const Token& token) {
    return token.punct == Punct::Semicolon || token.punct == Punct::LeftBrace ||
           token.punct == Punct::RightBrace;
}

// What stands before a declared name: a type, perhaps with a length or space, or another
// declarator.
bool leads_name(const Token& token) {
    return token.kind == TokenKind::Identifier || token.kind == TokenKind::String ||
           token.punct == Punct::Comma || token.punct == Punct::RightBracket ||
           token.punct == Punct::Multiply || token.punct == Punct::BitAnd;
}

}  // namespace

void ParseRecovery::add(std::string_view name, bool whole_file) {
    uint32_t where = whole_file ? kWholeFile : uint32_t(definitions_.size() - 1);
    std::vector<uint32_t>& all = names_[name];
    if (all.empty() || all.back() != where) all.push_back(where);
}

// A declaration begins with a type, or with two names of which the first may be a misspelt one. Its
// names stand behind the type or a ',', or before a '='. A macro's use that was dropped may have
// been any statement or definition.
void ParseRecovery::lose(const std::vector<Token>& tokens, uint32_t begin, uint32_t end,
                         bool declares, bool whole_file) {
    bool declaration = declares;
    bool starts = true;  // a statement
    for (uint32_t k = begin; k < end && k + 1 < tokens.size(); ++k) {
        const Token& token = tokens[k];
        bool first = std::exchange(starts, false);
        if (first && token.lost && whole_file) everything_ = true;
        if (first && token.lost) add("", whole_file);
        if (ends_statement(token)) {
            starts = true;
            declaration = declares;
        }
        if (token.kind != TokenKind::Identifier) continue;
        declaration |= is_type(token) || (first && tokens[k + 1].kind == TokenKind::Identifier);
        bool led = first ? declares || whole_file : leads_name(tokens[k - 1]);
        bool named = led || tokens[k + 1].punct == Punct::Assign;
        if ((declaration || whole_file) && named) add(token.text, whole_file);
    }
}

size_t ParseRecovery::definition_of(uint32_t token) const {
    auto after = std::upper_bound(definitions_.begin(), definitions_.end(), token,
                                  [](uint32_t t, const Definition& d) { return t < d.begin; });
    return after == definitions_.begin() ? 0 : size_t(after - definitions_.begin()) - 1;
}

bool ParseRecovery::declares(std::string_view name, uint32_t token) const {
    auto found = names_.find(name);
    if (found == names_.end()) return false;
    size_t here = definition_of(token);
    return std::any_of(found->second.begin(), found->second.end(),
                       [&](uint32_t where) { return where == kWholeFile || where == here; });
}

bool ParseRecovery::hides(std::string_view name, uint32_t token) const {
    return everything_ || declares(name, token) || declares("", token);
}

bool ParseRecovery::touches(uint32_t token) const {
    return everything_ || (!definitions_.empty() && definitions_[definition_of(token)].broken);
}

}  // namespace kinora::rsl
