// jit/x64/pool.cpp: constants that stand behind the code, each once.
#include "jit/x64/pool_p.h"

#include <algorithm>
#include <bit>

namespace kinora::jit::x64 {

namespace {

size_t hash(uint32_t bits) {
    return (bits * 0x9e3779b1u) >> 12;
}

}  // namespace

size_t Pool::find(uint32_t bits) {
    size_t mask = table_.size() - 1;
    for (size_t at = hash(bits) & mask;; at = (at + 1) & mask) {
        int32_t known = table_[at];
        if (known >= 0 && words_[static_cast<size_t>(known)] == bits)
            return static_cast<size_t>(known);
        if (known >= 0) continue;
        table_[at] = static_cast<int32_t>(words_.size());
        words_.push_back(bits);
        if (words_.size() * 2 > table_.size()) grow();
        return words_.size() - 1;
    }
}

asmjit::x86::Mem Pool::row(std::span<const float> values) {
    std::array<uint32_t, 16> words;
    for (size_t k = 0; k < words.size(); ++k)
        words[k] = std::bit_cast<uint32_t>(values[k % values.size()]);
    auto at = std::find(rows_.begin(), rows_.end(), words) - rows_.begin();
    if (static_cast<size_t>(at) == rows_.size()) rows_.push_back(words);
    return asmjit::x86::ptr(rows_label_, static_cast<int32_t>(at) * 64);
}

void Pool::grow() {
    table_.assign(table_.size() * 2, -1);
    size_t mask = table_.size() - 1;
    for (size_t k = 0; k < words_.size(); ++k) {
        size_t at = hash(words_[k]) & mask;
        while (table_[at] >= 0) at = (at + 1) & mask;
        table_[at] = static_cast<int32_t>(k);
    }
}

void Pool::embed(asmjit::x86::Assembler& a) {
    a.align(asmjit::AlignMode::kData, 64);
    a.bind(iota_);
    uint32_t iota[16];
    for (uint32_t k = 0; k < 16; ++k) iota[k] = k;
    a.embed(iota, sizeof iota);
    a.bind(rows_label_);
    if (!rows_.empty()) a.embed(rows_.data(), rows_.size() * sizeof rows_[0]);
    a.bind(label_);
    std::vector<uint32_t> bytes;
    for (uint32_t word : words_) bytes.insert(bytes.end(), static_cast<size_t>(copies_), word);
    if (!bytes.empty()) a.embed(bytes.data(), bytes.size() * 4);
}

}  // namespace kinora::jit::x64
