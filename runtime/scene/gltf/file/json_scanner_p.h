// runtime/scene/gltf/file/json_scanner_p.h: steps through a JSON text (RFC 8259), from one position
// to the next. The text need not be well-formed. Private to runtime/scene/gltf/file.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/scene/gltf/file/json_scan.h"

namespace kinora {

class JsonScanner {
  public:
    explicit JsonScanner(std::string_view text) : text_(text) {}

    size_t at() const { return at_; }
    char peek() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != text_.npos)
            ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    // A string with its quotes.
    std::optional<JsonRange> string() {
        if (peek() != '"') return std::nullopt;
        size_t begin = at_++;
        while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
        if (at_ >= text_.size()) return std::nullopt;
        ++at_;
        return JsonRange{uint32_t(begin), uint32_t(at_)};
    }
    // Any value; false at the end of the text.
    bool skip_value() {
        size_t depth = 0;
        do {
            char c = peek();
            if (c == '"') {
                if (!string()) return false;
            } else if (c == '{' || c == '[') {
                ++depth;
                ++at_;
            } else if (c == '}' || c == ']') {
                if (depth == 0) return false;
                --depth;
                ++at_;
            } else if (c == ',' || c == ':') {
                if (depth == 0) return false;
                ++at_;
            } else if (c == '\0') {
                return false;
            } else {
                while (at_ < text_.size() &&
                       std::string_view(" \t\r\n,:{}[]\"").find(text_[at_]) == text_.npos)
                    ++at_;
            }
        } while (depth > 0);
        return true;
    }

  private:
    std::string_view text_;
    size_t at_ = 0;
};

}  // namespace kinora
