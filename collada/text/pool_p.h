// collada/text/pool_p.h: small pieces out of an arena.
#pragma once

#include <cstring>
#include <span>
#include <string_view>

#include "runtime/base/arena.h"

namespace kinora::collada {

// Small pieces out of the arena, whose own steps are 64 bytes.
class Pool {
  public:
    explicit Pool(Arena& arena) : arena_(arena) {}

    void* take(size_t bytes) {
        bytes = (bytes + 7) & ~size_t(7);
        if (bytes > left_) {
            taken_ += bytes > kBlock / 4 ? bytes : kBlock;
            if (bytes > kBlock / 4) return arena_.allocate(bytes);
            next_ = static_cast<char*>(arena_.allocate(kBlock));
            left_ = kBlock;
        }
        void* taken = next_;
        next_ += bytes;
        left_ -= bytes;
        return taken;
    }

    uint64_t taken() const { return taken_; }  // bytes of the arena

    template <class T>
    std::span<const T> copy(std::span<const T> items) {
        if (items.empty()) return {};
        T* to = static_cast<T*>(take(items.size_bytes()));
        std::memcpy(static_cast<void*>(to), items.data(), items.size_bytes());
        return {to, items.size()};
    }

    std::string_view copy(std::string_view text) {
        auto c = copy(std::span<const char>(text.data(), text.size()));
        return {c.data(), c.size()};
    }

  private:
    static constexpr size_t kBlock = 64 * 1024;
    Arena& arena_;
    char* next_ = nullptr;
    size_t left_ = 0;
    uint64_t taken_ = 0;
};

}  // namespace kinora::collada
