// rsl/model/text_table.cpp: texts by number.
#include "rsl/model/text_table.h"

#include <bit>

#include "runtime/base/check.h"

namespace kinora::rsl {

TextTable::Place TextTable::place_of(int32_t id) {
    const uint32_t n = uint32_t(id) + kFirst;
    const size_t block = size_t(std::bit_width(n / kFirst) - 1);
    return {block, n - (size_t(kFirst) << block)};
}

int32_t TextTable::id(std::string_view text) {
    std::lock_guard lock(mutex_);
    if (auto found = ids_.find(text); found != ids_.end()) return found->second;
    const int32_t id = count();
    const Place place = place_of(id);
    CHECK_LT(place.block, blocks_.size());
    auto& block = blocks_[place.block];
    if (!block) block = std::make_unique<std::string[]>(size_t(kFirst) << place.block);
    block[place.at] = text;
    ids_.emplace(block[place.at], id);
    bytes_ += text.size();
    count_.store(id + 1, std::memory_order_release);
    return id;
}

const std::string& TextTable::text(int32_t id) const {
    CHECK(id >= 0 && id < count());
    const Place place = place_of(id);
    return blocks_[place.block][place.at];
}

size_t TextTable::bytes() const {
    std::lock_guard lock(mutex_);
    return bytes_;
}

}  // namespace kinora::rsl
