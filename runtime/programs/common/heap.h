// runtime/programs/common/heap.h: memory of a program that runs once and ends.
#pragma once

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "runtime/base/memory/pages.h"

namespace kinora {

// What is freed serves what comes next, instead of going back to the kernel, and the next so many
// bytes are there at once: provide_pages().
inline void ready_heap(size_t bytes) {
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

inline constexpr size_t kHeapOfStart = 192 << 10;  // of the table of options

// What reading and building a scene takes at least: much less than most scenes need.
inline size_t heap_of_scene(const std::filesystem::path& file) {
    std::error_code code;
    const uintmax_t bytes = std::filesystem::file_size(file, code);
    constexpr uintmax_t kLeast = 1 << 20, kMost = 32 << 20;
    return size_t(kLeast + (code ? 0 : std::min(3 * bytes, kMost)));
}

}  // namespace kinora
