// tests/runtime/player/live_memory.cpp: an operator new that adds up what lives. A file of its own,
// so that no caller sees its body (GCC 12 would take free() for a mismatch).
#include "live_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

static std::atomic<size_t> g_live{0}, g_most{0};

size_t live_memory() {
    return g_live;
}

size_t most_live_memory() {
    return g_most.exchange(g_live);
}

static void add(size_t bytes) {
    const size_t live = g_live += bytes;
    size_t most = g_most;
    while (live > most && !g_most.compare_exchange_weak(most, live)) {
    }
}

static void* allocate(size_t bytes, size_t alignment) {
    if (bytes == 0) bytes = 1;
    void* p = nullptr;
    if (alignment <= alignof(std::max_align_t))
        p = std::malloc(bytes);
    else if (posix_memalign(&p, alignment, bytes) != 0)
        p = nullptr;
    if (p) add(malloc_usable_size(p));
    return p;
}
static void* allocate_or_throw(size_t bytes, size_t alignment) {
    if (void* p = allocate(bytes, alignment)) return p;
    throw std::bad_alloc();
}
static void release(void* p) {
    if (p) g_live -= malloc_usable_size(p);
    std::free(p);
}

void* operator new(size_t bytes) {
    return allocate_or_throw(bytes, 1);
}
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
    return allocate(bytes, 1);
}
void* operator new(size_t bytes, std::align_val_t alignment) {
    return allocate_or_throw(bytes, static_cast<size_t>(alignment));
}
void* operator new(size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
    return allocate(bytes, static_cast<size_t>(alignment));
}
void operator delete(void* p) noexcept {
    release(p);
}
void operator delete(void* p, size_t) noexcept {
    release(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
    release(p);
}
void operator delete(void* p, size_t, std::align_val_t) noexcept {
    release(p);
}
