// tests/runtime/allocations_of_ours.cpp: a counting operator new that knows its caller. A file of
// its own, so that no caller sees its body (GCC 12 would take free() for a mismatch).
#include "allocations_of_ours.h"

#include <dlfcn.h>
#include <execinfo.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

static std::atomic<bool> g_watching{false};
static std::atomic<size_t> g_count{0};
static std::atomic<const void*> g_first{nullptr};

static std::string_view module_of(const void* code) {
    Dl_info info{};
    return dladdr(code, &info) && info.dli_fname ? info.dli_fname : "";
}
static bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

// Embree's strings grow in code of the C++ library that the linker may take from this program, so
// the nearest callers are looked at, not the first alone.
static bool is_embrees() {
    constexpr int kOwnFrames = 2, kNear = 12;
    void* frames[kOwnFrames + kNear];
    int count = backtrace(frames, kOwnFrames + kNear);
    for (int i = kOwnFrames; i < count; ++i)
        if (contains(module_of(frames[i]), "libembree")) return true;
    return false;
}

[[gnu::noinline]] static void count_ours(const void* caller) {
    if (contains(module_of(caller), "libtbb") || is_embrees()) return;
    if (g_count++ == 0) g_first = caller;
}

static void count(const void* caller) {
    if (g_watching) count_ours(caller);
}

void watch_allocations() {
    g_count = 0;
    g_first = nullptr;
    g_watching = true;
}

size_t allocations_of_ours() {
    g_watching = false;
    return g_count;
}

std::string first_allocation_of_ours() {
    Dl_info info{};
    const void* at = g_first;
    char text[300] = "nowhere";
    if (at && dladdr(at, &info))
        std::snprintf(
            text, sizeof text, "%s+0x%zx", info.dli_fname,
            size_t(reinterpret_cast<uintptr_t>(at) - reinterpret_cast<uintptr_t>(info.dli_fbase)));
    return text;
}

static void* allocate(size_t bytes, size_t alignment) {
    void* p = nullptr;
    if (alignment <= alignof(std::max_align_t)) return std::malloc(bytes ? bytes : 1);
    return posix_memalign(&p, alignment, bytes ? bytes : 1) == 0 ? p : nullptr;
}

void* operator new(size_t bytes) {
    count(__builtin_return_address(0));
    if (void* p = allocate(bytes, 1)) return p;
    throw std::bad_alloc();
}
void* operator new[](size_t bytes) {
    count(__builtin_return_address(0));
    if (void* p = allocate(bytes, 1)) return p;
    throw std::bad_alloc();
}
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
    count(__builtin_return_address(0));
    return allocate(bytes, 1);
}
void* operator new[](size_t bytes, const std::nothrow_t&) noexcept {
    count(__builtin_return_address(0));
    return allocate(bytes, 1);
}
void* operator new(size_t bytes, std::align_val_t alignment) {
    count(__builtin_return_address(0));
    if (void* p = allocate(bytes, static_cast<size_t>(alignment))) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete[](void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, size_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, size_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete(void* p, size_t, std::align_val_t) noexcept {
    std::free(p);
}
