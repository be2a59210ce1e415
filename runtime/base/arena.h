// runtime/base/arena.h: memory that is handed out in order and given back all at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace kinora {

// A bump allocator in 64-byte steps. Blocks are kept across reset(), so an arena that has met its
// largest frame allocates no more. Not thread-safe: one arena a thread.
class Arena {
  public:
    explicit Arena(size_t block_bytes = 256 * 1024) : block_bytes_(block_bytes) {}
    Arena(Arena&&) = default;
    Arena& operator=(Arena&&) = default;

    // Uninitialised, 64-byte aligned.
    void* allocate(size_t bytes);
    template <class T>
    std::span<T> allocate_span(size_t count) {
        static_assert(std::is_trivially_destructible_v<T>);
        return {static_cast<T*>(allocate(count * sizeof(T))), count};
    }

    // mark() ... release(mark) gives back all that was taken in between.
    struct Mark {
        size_t block = 0;
        size_t used = 0;
    };
    Mark mark() const { return {block_, used_}; }
    void release(Mark m) {
        block_ = m.block;
        used_ = m.used;
    }
    void reset() { release({}); }
    size_t capacity() const;

  private:
    struct Free {
        void operator()(std::byte* p) const;
    };
    struct Block {
        std::unique_ptr<std::byte, Free> bytes;
        size_t size;
    };
    std::vector<Block> blocks_;
    size_t block_ = 0;  // the block in use; blocks_.size() when none
    size_t used_ = 0;
    size_t block_bytes_;
};

}  // namespace kinora
