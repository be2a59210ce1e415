// runtime/scene/ri/bytestream/report_p.h: findings of one stream.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <utility>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/bytestream/lexer_p.h"
#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {

// A text of the stream for a message.
inline std::string shown(std::string_view text) {
    constexpr size_t kLongest = 80;
    return text.size() <= kLongest ? std::string(text)
                                   : fmt::format("{}...", text.substr(0, kLongest));
}

// The first kMost are reported, the rest is counted.
class Report {
  public:
    Report(Context& context, FileId file) : context_(context), file_(file) {}

    Location place(const Token& token) const { return {file_, token.begin, token.end}; }
    // Lines and columns say nothing of what is encoded.
    static std::string byte(const Token& token) {
        return token.encoded ? fmt::format(" (byte {})", token.begin) : "";
    }

    template <class... Args>
    void add(const FindingInfo& info, const Token& at, const Args&... args) {
        add(info, place(at), args...);
    }
    template <class... Args>
    void add(const FindingInfo& info, Location at, const Args&... args) {
        if (++count_ > kMost) return;
        Location request = std::exchange(context_.where, at);
        context_.error(info, args...);
        context_.where = request;
    }
    void finish() {
        if (count_ <= kMost) return;
        context_.where = {file_, 0, 0};
        context_.error(Code::RIB_MORE, count_ - kMost);
    }

  private:
    static constexpr size_t kMost = 200;
    Context& context_;
    FileId file_;
    size_t count_ = 0;
};

}  // namespace kinora::ri
