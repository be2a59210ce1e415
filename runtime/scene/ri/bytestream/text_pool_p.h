// runtime/scene/ri/bytestream/text_pool_p.h: strings with a 0 behind them, given back all at once.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

namespace kinora::ri {

class TextPool {
  public:
    // Memory of so many bytes.
    char* take(size_t bytes) {
        if (bytes > left_) {
            left_ = std::max(bytes, kBlock);
            blocks_.push_back(std::make_unique_for_overwrite<char[]>(left_));
            next_ = blocks_.back().get();
        }
        char* taken = next_;
        next_ += bytes, left_ -= bytes;
        return taken;
    }
    // Gives back the end of what was taken last.
    void give_back(size_t bytes) { next_ -= bytes, left_ += bytes; }

    std::string_view copy(std::string_view text) {
        char* to = take(text.size() + 1);
        std::copy(text.begin(), text.end(), to);
        to[text.size()] = 0;
        return {to, text.size()};
    }

    // Views end. One block of the usual size is kept.
    void clear() {
        if (blocks_.size() == 1 && size_t(next_ - blocks_[0].get()) + left_ == kBlock) {
            next_ = blocks_[0].get();
            left_ = kBlock;
            return;
        }
        blocks_.clear();
        left_ = 0;
    }

  private:
    static constexpr size_t kBlock = 16 * 1024;
    std::vector<std::unique_ptr<char[]>> blocks_;
    char* next_ = nullptr;
    size_t left_ = 0;  // of the last block
};

}  // namespace kinora::ri
