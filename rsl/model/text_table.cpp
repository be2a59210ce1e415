// rsl/model/text_table.cpp: texts by number.
#include "rsl/model/text_table.h"

#include "runtime/base/check.h"

namespace kinora::rsl {

int32_t TextTable::id(std::string_view text) {
    std::lock_guard lock(mutex_);
    if (auto found = ids_.find(text); found != ids_.end()) return found->second;
    const std::string& kept = texts_.emplace_back(text);
    int32_t id = int32_t(texts_.size()) - 1;
    ids_.emplace(kept, id);
    bytes_ += text.size();
    return id;
}

const std::string& TextTable::text(int32_t id) const {
    std::lock_guard lock(mutex_);
    CHECK(id >= 0 && size_t(id) < texts_.size());
    return texts_[size_t(id)];
}

int32_t TextTable::count() const {
    std::lock_guard lock(mutex_);
    return int32_t(texts_.size());
}

size_t TextTable::bytes() const {
    std::lock_guard lock(mutex_);
    return bytes_;
}

}  // namespace kinora::rsl
