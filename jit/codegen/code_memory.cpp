// jit/codegen/code_memory.cpp: mmap writable, copy, mprotect executable.
#include "jit/codegen/code_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstring>

namespace kinora::jit {

namespace {

std::atomic<bool> denied = false;

size_t whole_pages(size_t bytes) {
    auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
    return (bytes + page - 1) / page * page;
}

}  // namespace

CodeMemory::~CodeMemory() {
    munmap(pages_, bytes_);
}

namespace {

std::shared_ptr<const CodeMemory> map_code(std::span<const uint8_t> code) {
    size_t bytes = whole_pages(code.size());
    void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) return nullptr;
    // Where code ends, int3: a stray jump traps instead of sliding on.
    std::memset(pages, 0xcc, bytes);
    std::memcpy(pages, code.data(), code.size());
    if (mprotect(pages, bytes, PROT_READ | PROT_EXEC) != 0) {
        munmap(pages, bytes);
        return nullptr;
    }
    auto* begin = static_cast<char*>(pages);
    __builtin___clear_cache(begin, begin + bytes);
    return std::make_shared<const CodeMemory>(pages, bytes);
}

}  // namespace

std::shared_ptr<const CodeMemory> make_executable(std::span<const uint8_t> code) {
    if (denied || code.empty()) return nullptr;
    return map_code(code);
}

bool may_execute() {
    static const bool may = [] {
        constexpr uint8_t kBytes[8] = {};
        return map_code(kBytes) != nullptr;
    }();
    return may;
}

void deny_executable_memory(bool deny) {
    denied = deny;
}

}  // namespace kinora::jit
