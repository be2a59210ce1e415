// jit/codegen/dwarf_bytes_p.h: bytes as DWARF and ELF write them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace kinora::jit {

class Bytes {
  public:
    template <class T>
    void put(T value) {
        static_assert(std::is_trivially_copyable_v<T>);
        size_t at = data.size();
        data.resize(at + sizeof value);
        std::memcpy(data.data() + at, &value, sizeof value);
    }
    void byte(int value) { put(static_cast<uint8_t>(value)); }
    void text(const std::string& s) {
        for (char c : s) put(c);
        byte(0);
    }
    void unsigned_leb(uint64_t value) {
        do {
            int low = static_cast<int>(value & 0x7f);
            value >>= 7;
            byte(value != 0 ? low | 0x80 : low);
        } while (value != 0);
    }
    void signed_leb(int64_t value) {
        for (;;) {
            int low = static_cast<int>(value & 0x7f);
            value >>= 7;
            bool done = (value == 0 && (low & 0x40) == 0) || (value == -1 && (low & 0x40) != 0);
            byte(done ? low : low | 0x80);
            if (done) return;
        }
    }
    void patch(size_t at, uint32_t value) { std::memcpy(data.data() + at, &value, sizeof value); }
    size_t size() const { return data.size(); }

    std::vector<std::byte> data;
};

// A length word, filled in when what follows is done.
class Unit {
  public:
    explicit Unit(Bytes& bytes) : bytes_(bytes), at_(bytes.size()) { bytes.put<uint32_t>(0); }
    ~Unit() { bytes_.patch(at_, static_cast<uint32_t>(bytes_.size() - at_ - 4)); }

  private:
    Bytes& bytes_;
    size_t at_;
};

}  // namespace kinora::jit
