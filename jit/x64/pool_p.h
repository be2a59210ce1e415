// jit/x64/pool_p.h: constants that stand behind the code, each once.
#pragma once

#include <asmjit/x86.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace kinora::jit::x64 {

// Words found by their bits; an entry is one word (AVX-512 broadcasts it) or 8 copies (AVX2).
class Pool {
  public:
    Pool(asmjit::x86::Assembler& a, int copies)
        : label_(a.newLabel()),
          rows_label_(a.newLabel()),
          iota_(a.newLabel()),
          copies_(copies),
          table_(64, -1) {}

    asmjit::x86::Mem word(uint32_t bits) {
        return asmjit::x86::ptr(label_, static_cast<int32_t>(find(bits)) * 4 * copies_);
    }
    // 16 words: the values given (8 or 16), repeated.
    asmjit::x86::Mem row(std::span<const float> values);
    // The row 0, 1, 2, ...
    asmjit::x86::Mem iota() const { return asmjit::x86::ptr(iota_); }

    // Writes everything at the end of the code.
    void embed(asmjit::x86::Assembler& a);

  private:
    size_t find(uint32_t bits);
    void grow();

    asmjit::Label label_, rows_label_, iota_;
    int copies_;
    std::vector<uint32_t> words_;
    std::vector<std::array<uint32_t, 16>> rows_;
    std::vector<int32_t> table_;  // open addressing, index into words_ or -1
};

}  // namespace kinora::jit::x64
