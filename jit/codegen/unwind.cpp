// jit/codegen/unwind.cpp: rules of the stack as call frame instructions, and the C++ runtime that
// reads them.
#include "jit/codegen/unwind.h"

#include "jit/codegen/dwarf_bytes_p.h"
#include "runtime/base/check.h"

// The C++ runtime's (libgcc's), for code that is made while a program runs.
extern "C" void __register_frame(const void* eh_frame);
extern "C" void __deregister_frame(const void* eh_frame);

namespace kinora::jit {

namespace {

// Call frame instructions.
enum Rule {
    kAdvance4 = 0x04,
    kOffsetExtended = 0x05,
    kRestoreExtended = 0x06,
    kDefineFrame = 0x0c,
    kFrameOffset = 0x0e,
    kOffset = 0x80,
    kRestore = 0xc0,
};
constexpr int kWord = 8;  // what offsets count
constexpr int kShortRegisters = 64;

void append(std::vector<std::byte>& to, const Bytes& bytes) {
    to.insert(to.end(), bytes.data.begin(), bytes.data.end());
}

void put_saved(Bytes& bytes, int reg, int below_end) {
    if (reg < kShortRegisters) {
        bytes.byte(kOffset | reg);
    } else {
        bytes.byte(kOffsetExtended);
        bytes.unsigned_leb(static_cast<uint64_t>(reg));
    }
    bytes.unsigned_leb(static_cast<uint64_t>(below_end / kWord));
}

// Records end at whole words; 0 is the rule that does nothing.
void pad(Bytes& bytes) {
    while (bytes.size() % kWord != 0) bytes.byte(0);
}

}  // namespace

void UnwindWriter::advance(size_t at) {
    CHECK_GE(at, at_);
    if (at == at_) return;
    Bytes bytes;
    bytes.byte(kAdvance4);
    bytes.put(static_cast<uint32_t>(at - at_));
    append(rules_, bytes);
    at_ = at;
}

void UnwindWriter::frame_bytes(size_t at, int bytes) {
    advance(at);
    Bytes rule;
    rule.byte(kFrameOffset);
    rule.unsigned_leb(static_cast<uint64_t>(bytes));
    append(rules_, rule);
}

void UnwindWriter::saved(int reg, int below_end) {
    Bytes rule;
    put_saved(rule, reg, below_end);
    append(rules_, rule);
    saved_.insert(reg);
}

void UnwindWriter::restored(int reg) {
    Bytes rule;
    if (reg < kShortRegisters) {
        rule.byte(kRestore | reg);
    } else {
        rule.byte(kRestoreExtended);
        rule.unsigned_leb(static_cast<uint64_t>(reg));
    }
    append(rules_, rule);
    saved_.erase(reg);
}

void UnwindWriter::begin_function(size_t at) {
    frame_bytes(at, machine_.entry_bytes);
    while (!saved_.empty()) restored(*saved_.begin());
}

std::vector<std::byte> UnwindWriter::eh_frame(const void* code, size_t bytes) const {
    Bytes section;
    {
        Unit common(section);
        section.put<uint32_t>(0);  // a common record
        section.byte(1);           // version
        section.text("");          // nothing beyond the standard: addresses are whole words
        section.unsigned_leb(1);   // a step of code
        section.signed_leb(-kWord);
        section.byte(machine_.return_address);
        section.byte(kDefineFrame);
        section.unsigned_leb(static_cast<uint64_t>(machine_.stack_pointer));
        section.unsigned_leb(static_cast<uint64_t>(machine_.entry_bytes));
        if (machine_.entry_bytes > 0)
            put_saved(section, machine_.return_address, machine_.entry_bytes);
        pad(section);
    }
    {
        Unit rules(section);
        section.put(static_cast<uint32_t>(section.size()));  // back to the common record
        section.put<uint64_t>(reinterpret_cast<uintptr_t>(code));
        section.put(static_cast<uint64_t>(bytes));
        section.data.insert(section.data.end(), rules_.begin(), rules_.end());
        pad(section);
    }
    section.put<uint32_t>(0);
    return std::move(section.data);
}

UnwindRegistration::UnwindRegistration(std::span<const std::byte> eh_frame)
    : eh_frame_(eh_frame.data()) {
    __register_frame(eh_frame_);
}

UnwindRegistration::~UnwindRegistration() {
    __deregister_frame(eh_frame_);
}

}  // namespace kinora::jit
