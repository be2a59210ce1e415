// runtime/base/memory/heap.cpp: settings of malloc, and pages that are there before they are used.
#include "runtime/base/memory/heap.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "runtime/base/memory/pages.h"

namespace kinora {

namespace {

constexpr int kReserved = 1 << 30;     // bytes of address space; memory when it is used
constexpr uintptr_t kLarge = 2 << 20;  // a large page
constexpr int kGrowth = 16 << 20;      // of a heap that needs more than that
constexpr int kMappedFrom = 32 << 20;  // larger blocks are mapped by themselves, as usual

bool is_limited(__rlimit_resource_t what) {
    rlimit limit{};
    return getrlimit(what, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace

void ready_heap(size_t bytes) {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 64 << 20);
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
    void* block = std::malloc(bytes);
    if (block) provide_pages(block, bytes);
    std::free(block);
#else
    (void)bytes;
#endif
}

size_t heap_of_scene(const std::filesystem::path& file) {
    std::error_code code;
    const uintmax_t bytes = std::filesystem::file_size(file, code);
    constexpr uintmax_t kLeast = 1 << 20, kMost = 32 << 20;
    return size_t(kLeast + (code ? 0 : std::min(3 * bytes, kMost)));
}

void use_large_pages() {
#ifdef __GLIBC__
    if (is_limited(RLIMIT_AS) || is_limited(RLIMIT_DATA)) return;
    mallopt(M_ARENA_MAX, 1);  // threads share that heap
    mallopt(M_MMAP_THRESHOLD, kMappedFrom);
    mallopt(M_TRIM_THRESHOLD, kReserved + 2 * kMappedFrom);
    mallopt(M_TOP_PAD, kReserved);
    const auto before = reinterpret_cast<uintptr_t>(sbrk(0));
    void* more = std::malloc(kMappedFrom / 2);         // than is there
    if (more) *static_cast<volatile char*>(more) = 0;  // else compilers leave both calls away
    std::free(more);
    mallopt(M_TOP_PAD, kGrowth);
    const auto end = reinterpret_cast<uintptr_t>(sbrk(0)) & ~(kLarge - 1),
               begin = (before + kLarge - 1) & ~(kLarge - 1);
    if (end > begin) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace kinora
