// tests/fuzzers/fuzzer.h: what the libFuzzer targets share: a promise kept or the process ends, and
// a bound on memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinora::fuzz {

// Ends the process with the text unless it is empty; libFuzzer then keeps the input.
void expect(const std::string& broken_promise);

// Watches live heap memory from its making on: the process ends where that passes 20 times the
// bytes read and 64 MB, the readers' bound.
class MemoryBound {
  public:
    explicit MemoryBound(size_t bytes_read);
    ~MemoryBound();
};

inline std::string_view text_of(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace kinora::fuzz
