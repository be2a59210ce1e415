// rsl/model/text_table.h: texts by number: thread-safe, and it only grows. Who reads a text waits
// for nobody: shaders' questions to the renderer name what they want by texts.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

namespace kinora::rsl {

class TextTable {
  public:
    TextTable() { id(""); }
    int32_t id(std::string_view text);  // 0 is ""
    const std::string& text(int32_t id) const;
    int32_t count() const { return count_.load(std::memory_order_acquire); }
    size_t bytes() const;

  private:
    // Block b holds kFirst << b texts: addresses stay, and none is written once it is counted.
    static constexpr uint32_t kFirst = 64;
    static constexpr int kBlocks = 26;
    struct Place {
        size_t block, at;
    };
    static Place place_of(int32_t id);

    mutable std::mutex mutex_;  // of who adds
    std::array<std::unique_ptr<std::string[]>, kBlocks> blocks_;
    std::atomic<int32_t> count_ = 0;
    std::unordered_map<std::string_view, int32_t> ids_;
    size_t bytes_ = 0;
};

}  // namespace kinora::rsl
