// runtime/scene/description/pair_numbers.h: a number for each pair of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kinora {

// Gives each pair (a, b) one number, in order of first sight. (~0, ~0) is no pair.
class PairNumbers {
  public:
    explicit PairNumbers(size_t expected = 0) {
        size_t size = 16;
        while (size < 2 * expected) size *= 2, --shift_;
        slots_.assign(size, {~0ull, 0});
    }
    // The number of the pair; `next` if it is new (then it is taken).
    uint32_t number(uint32_t a, uint32_t b, uint32_t next) {
        uint64_t key = uint64_t(a) << 32 | b;
        size_t at = slot_of(key);
        if (slots_[at].key == key) return slots_[at].number;
        slots_[at] = {key, next};
        if (2 * ++used_ > slots_.size()) grow();
        return next;
    }
    bool contains(uint32_t a, uint32_t b) const {
        uint64_t key = uint64_t(a) << 32 | b;
        return slots_[slot_of(key)].key == key;
    }

  private:
    struct Slot {
        uint64_t key;
        uint32_t number;
    };
    size_t slot_of(uint64_t key) const {
        size_t at = size_t((key * 0x9e3779b97f4a7c15ull) >> shift_);  // the highest bits mix best
        while (slots_[at].key != ~0ull && slots_[at].key != key)
            at = (at + 1) & (slots_.size() - 1);
        return at;
    }
    void grow() {
        std::vector<Slot> old(2 * slots_.size(), Slot{~0ull, 0});
        old.swap(slots_);
        --shift_;
        for (const Slot& slot : old)
            if (slot.key != ~0ull) slots_[slot_of(slot.key)] = slot;
    }

    std::vector<Slot> slots_;
    int shift_ = 60;  // 64 - log2(slots_.size())
    size_t used_ = 0;
};

}  // namespace kinora
