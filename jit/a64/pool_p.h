// jit/a64/pool_p.h: constants that stand behind the code, each once, as rows of 4 lanes.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <unordered_map>
#include <vector>

#include "jit/a64/asmjit_p.h"

namespace kinora::jit::a64 {

// A literal pool: AsmJit here encodes `fmov vN.4s, #imm` wrongly for even N.
class Pool {
  public:
    static constexpr int32_t kIota = 0;       // 0, 1, 2, 3
    static constexpr int32_t kLaneBits = 16;  // 1, 2, 4, 8

    // Where the row of 4 copies of `bits` lies.
    int32_t word(uint32_t bits) {
        auto [at, is_new] = known_.try_emplace(bits, static_cast<int32_t>(16 * rows_.size()));
        if (is_new) rows_.push_back({bits, bits, bits, bits});
        return at->second;
    }

    // Where 8 or 16 words lie behind each other. Lists are few and each is asked for by one op.
    int32_t row(std::span<const float> words) {
        auto first = static_cast<int32_t>(16 * rows_.size());
        for (size_t k = 0; k < words.size(); k += 4)
            std::memcpy(rows_.emplace_back().data(), &words[k], 16);
        return first;
    }

    void embed(asmjit::a64::Assembler& a) const { a.embed(rows_.data(), rows_.size() * 16); }

  private:
    std::vector<std::array<uint32_t, 4>> rows_ = {{0, 1, 2, 3}, {1, 2, 4, 8}};
    std::unordered_map<uint32_t, int32_t> known_;
};

}  // namespace kinora::jit::a64
