// tests/fuzzers/fuzzer.cpp: promises and the bound on memory, by the sanitizer's malloc hooks.
#include "tests/fuzzers/fuzzer.h"

#include <sanitizer/allocator_interface.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace kinora::fuzz {

namespace {

constexpr size_t kNoBound = std::numeric_limits<size_t>::max();
std::atomic<size_t> live{0};
std::atomic<size_t> most{kNoBound};

void on_malloc(const volatile void*, size_t size) {
    if (live.fetch_add(size) + size <= most) return;
    most = kNoBound;  // so that reporting may allocate
    std::fprintf(stderr, "memory: more than 20 times the bytes read and 64 MB\n");
    std::abort();
}

void on_free(const volatile void* block) {
    if (block) live -= __sanitizer_get_allocated_size(block);
}

const int kInstalled = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);

}  // namespace

void expect(const std::string& broken_promise) {
    if (broken_promise.empty()) return;
    std::fprintf(stderr, "broken: %s\n", broken_promise.c_str());
    std::abort();
}

MemoryBound::MemoryBound(size_t bytes_read) {
    if (!kInstalled) std::abort();
    most = live + 20 * bytes_read + (size_t(64) << 20);
}

MemoryBound::~MemoryBound() {
    most = kNoBound;
}

}  // namespace kinora::fuzz
