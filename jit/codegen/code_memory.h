// jit/codegen/code_memory.h: memory for generated code that is writable, then executable, never
// both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace kinora::jit {

// Pages of finished code, readable and executable; given back when the last owner lets go.
class CodeMemory {
  public:
    CodeMemory(void* pages, size_t bytes) : pages_(pages), bytes_(bytes) {}
    ~CodeMemory();
    CodeMemory(const CodeMemory&) = delete;
    CodeMemory& operator=(const CodeMemory&) = delete;

    const std::byte* data() const { return static_cast<const std::byte*>(pages_); }
    size_t bytes() const { return bytes_; }  // whole pages

  private:
    void* pages_;
    size_t bytes_;
};

// Copies position-independent `code` to fresh pages and makes them executable; a page that may run
// is never written again. Null where the system denies either step. The code starts at a
// page.
std::shared_ptr<const CodeMemory> make_executable(std::span<const uint8_t> code);

// Does the system let this process make memory executable at all? Asked of it once.
bool may_execute();

// For tests of the fallback: while set, make_executable gives null.
void deny_executable_memory(bool deny);

}  // namespace kinora::jit
