// jit/codegen/unwind.h: how exceptions and debuggers find their way out of generated code: the
// rules of its stack, as DWARF says them (version 4, section 6.4), in the form of .eh_frame (LSB
// 5, 10.6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace kinora::jit {

// Machines by their numbers of registers.
struct UnwindMachine {
    int stack_pointer, return_address;
    int entry_bytes;  // where a function begins: the frame's end above the stack pointer
};
inline constexpr UnwindMachine kUnwindX64 = {7, 16, 8};
inline constexpr UnwindMachine kUnwindA64 = {31, 30, 0};

// Collects rules while code is written; `at` is an offset in the code, and never falls.
class UnwindWriter {
  public:
    explicit UnwindWriter(UnwindMachine machine) : machine_(machine) {}

    void begin_function(size_t at);
    // From `at` on the frame ends this far above the stack pointer.
    void frame_bytes(size_t at, int bytes);
    // From the last `at` on the caller's register lies so far below the frame's end; or is itself.
    void saved(int reg, int below_end);
    void restored(int reg);

    // The section for code of that size at that address, which ends with an empty record.
    std::vector<std::byte> eh_frame(const void* code, size_t bytes) const;

  private:
    void advance(size_t at);

    UnwindMachine machine_;
    std::vector<std::byte> rules_;
    std::set<int> saved_;
    size_t at_ = 0;
};

// Makes code known to the C++ runtime, so that exceptions of services pass through it, for as long
// as this lives. `eh_frame` outlives it.
class UnwindRegistration {
  public:
    explicit UnwindRegistration(std::span<const std::byte> eh_frame);
    ~UnwindRegistration();
    UnwindRegistration(const UnwindRegistration&) = delete;
    UnwindRegistration& operator=(const UnwindRegistration&) = delete;

  private:
    const void* eh_frame_;
};

}  // namespace kinora::jit
