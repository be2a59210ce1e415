// rsl/text/token_input.cpp: the stack of replacements above the file.
#include "rsl/text/token_input.h"

namespace kinora::rsl {

void TokenInput::push(TokenList tokens, Macro* macro) {
    if (macro) macro->expanding = true;
    pending_.push_back({std::move(tokens), 0, macro});
}

void TokenInput::pop() {
    if (pending_.back().macro) pending_.back().macro->expanding = false;
    pending_.pop_back();
}

Token TokenInput::next() {
    while (pending_.size() > floor_) {
        Pending& top = pending_.back();
        if (top.next < top.tokens.size()) return top.tokens[top.next++];
        pop();
    }
    return isolated_ ? Token{} : files_.next();
}

Token TokenInput::peek() const {
    for (size_t i = pending_.size(); i > floor_; --i) {
        const Pending& p = pending_[i - 1];
        if (p.next < p.tokens.size()) return p.tokens[p.next];
    }
    return isolated_ ? Token{} : files_.peek();
}

TokenInput::Isolation::Isolation(TokenInput& input, TokenList list)
    : input_(input),
      floor_(std::exchange(input.floor_, input.pending_.size())),
      isolated_(std::exchange(input.isolated_, true)) {
    input_.push(std::move(list), nullptr);
}

TokenInput::Isolation::~Isolation() {
    while (input_.pending_.size() > input_.floor_) input_.pop();
    input_.isolated_ = isolated_;
    input_.floor_ = floor_;
}

}  // namespace kinora::rsl
