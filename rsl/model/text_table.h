// rsl/model/text_table.h: texts by number: thread-safe, and it only grows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

namespace kinora::rsl {

class TextTable {
  public:
    int32_t id(std::string_view text);  // 0 is ""
    const std::string& text(int32_t id) const;
    int32_t count() const;
    size_t bytes() const;

  private:
    mutable std::mutex mutex_;
    std::deque<std::string> texts_ = {""};  // stable addresses
    std::unordered_map<std::string_view, int32_t> ids_ = {{"", 0}};
    size_t bytes_ = 0;
};

}  // namespace kinora::rsl
