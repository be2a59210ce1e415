// runtime/base/memory/heap.h: how a program's heap grows, told to glibc's malloc as the program
// begins. Elsewhere nothing changes.
#pragma once

#include <cstddef>
#include <filesystem>

namespace kinora {

// For a program that runs once and ends: what is freed serves what comes next, instead of going
// back to the kernel, and the next so many bytes are there at once: provide_pages().
void ready_heap(size_t bytes);

inline constexpr size_t kHeapOfStart = 192 << 10;  // of the table of options

// What reading and building a scene takes at least: much less than most scenes need.
size_t heap_of_scene(const std::filesystem::path& file);

// For a program that stays and fills much memory soon: what malloc gives out, up to a gibibyte,
// lies in pages of 2 MiB where the system has them (madvise(2), MADV_HUGEPAGE). Each costs one
// fault instead of 512. Memory that is freed stays with the program up to that size. Where the
// address space is limited, nothing changes.
void use_large_pages();

}  // namespace kinora
