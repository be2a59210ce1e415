// tests/anim/allocation_count.cpp: a counting operator new. A file of its own, so that no caller
// sees its body (GCC 12 would take free() for a mismatch).
#include "allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

static std::atomic<size_t> g_allocations{0};

size_t allocation_count() {
    return g_allocations;
}

void* operator new(size_t bytes) {
    ++g_allocations;
    if (void* p = std::malloc(bytes ? bytes : 1)) return p;
    throw std::bad_alloc();
}
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
    ++g_allocations;
    return std::malloc(bytes ? bytes : 1);
}
void* operator new(size_t bytes, std::align_val_t alignment) {
    ++g_allocations;
    void* p = nullptr;
    if (posix_memalign(&p, static_cast<size_t>(alignment), bytes ? bytes : 1) == 0) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, size_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete(void* p, size_t, std::align_val_t) noexcept {
    std::free(p);
}
