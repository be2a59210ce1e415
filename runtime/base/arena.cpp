// runtime/base/arena.cpp: bump allocation in aligned blocks.
#include "runtime/base/arena.h"

#include <algorithm>
#include <new>

#include "runtime/base/memory/pages.h"

namespace kinora {

namespace {
constexpr size_t kAlignment = 64;
}

void Arena::Free::operator()(std::byte* p) const {
    ::operator delete(p, std::align_val_t(kAlignment));
}

void* Arena::allocate(size_t bytes) {
    bytes = (std::max<size_t>(bytes, 1) + kAlignment - 1) & ~(kAlignment - 1);
    while (block_ < blocks_.size() && used_ + bytes > blocks_[block_].size) {
        ++block_;
        used_ = 0;
    }
    if (block_ == blocks_.size()) {
        size_t size = std::max(bytes, block_bytes_);
        auto* memory = static_cast<std::byte*>(::operator new(size, std::align_val_t(kAlignment)));
        provide_pages(memory, size);
        blocks_.push_back({std::unique_ptr<std::byte, Free>(memory), size});
        used_ = 0;
    }
    void* result = blocks_[block_].bytes.get() + used_;
    used_ += bytes;
    return result;
}

size_t Arena::capacity() const {
    size_t total = 0;
    for (const Block& block : blocks_) total += block.size;
    return total;
}

}  // namespace kinora
