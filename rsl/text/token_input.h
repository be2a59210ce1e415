// rsl/text/token_input.h: the tokens to be read next: replacements of macros, then the file's.
#pragma once

#include <utility>
#include <vector>

#include "rsl/text/file_stack.h"
#include "rsl/text/macro_table.h"
#include "rsl/text/token.h"

namespace kinora::rsl {

class TokenInput {
  public:
    explicit TokenInput(FileStack& files) : files_(files) {}

    Token next();
    // What next() would give, without reading past the end of a replacement for good.
    Token peek() const;
    // These come next. The macro is off until they are read to the end.
    void push(TokenList tokens, Macro* macro);

    // Only a list is read, not the file.
    bool isolated() const { return isolated_; }
    // The next token is the file's.
    bool at_file() const { return !isolated_ && pending_.size() == floor_; }

    // For its life the list is all there is to read.
    class Isolation {
      public:
        Isolation(TokenInput& input, TokenList list);
        ~Isolation();
        Isolation(const Isolation&) = delete;

      private:
        TokenInput& input_;
        size_t floor_;
        bool isolated_;
    };

  private:
    struct Pending {
        TokenList tokens;
        size_t next = 0;
        Macro* macro = nullptr;  // to be enabled again when read to the end
    };
    void pop();

    FileStack& files_;
    std::vector<Pending> pending_;
    size_t floor_ = 0;  // pending_ below it is out of reach
    bool isolated_ = false;
};

}  // namespace kinora::rsl
