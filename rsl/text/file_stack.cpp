// rsl/text/file_stack.cpp: entering, reading and leaving files.
#include "rsl/text/file_stack.h"

#include <utility>

namespace kinora::rsl {

void FileStack::enter(SourceText source) {
    files_.push_back(
        {Lexer(source.text, *source.map), std::move(source.path), source.standard, {}});
}

void FileStack::leave() {
    ConditionStack& conditions = files_.back().conditions;
    for (; Condition* open = conditions.innermost(); conditions.close())
        reporter_.report(Code::RSL_UNTERMINATED_IF, open->where, 0, {});
    files_.pop_back();
}

void FileStack::report_trouble() {
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

Token FileStack::next() {
    Token token = files_.back().lexer.next();
    Location ignored;
    if (skipping())
        files_.back().lexer.take_trouble(ignored);
    else
        report_trouble();
    return token;
}

}  // namespace kinora::rsl
