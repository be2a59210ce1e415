// rsl/text/text_store.h: owns the texts that tokens point into, and where the bytes of each stand.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <utility>

#include "rsl/text/token.h"

namespace kinora::rsl {

class TextStore {
  public:
    // Texts live as long as `out`, maps as long as the store.
    explicit TextStore(TokenStream& out) : texts_(out.texts) {}

    std::string_view keep(std::string text) { return texts_.emplace_back(std::move(text)); }
    const SourceMap& keep(SourceMap map) { return maps_.emplace_back(std::move(map)); }
    // The tokens of a text that stands in no file.
    TokenList tokens_of(std::string text);

  private:
    std::deque<std::string>& texts_;
    std::deque<SourceMap> maps_;
};

}  // namespace kinora::rsl
