// runtime/base/memory/pages.cpp: madvise().
#include "runtime/base/memory/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace kinora {

namespace {

#ifdef MADV_POPULATE_WRITE
// Kernels that do not know the advice refuse, and pages come one by one.
void advise(void* memory, size_t bytes, uintptr_t page, int advice) {
    const auto first = reinterpret_cast<uintptr_t>(memory);
    const uintptr_t begin = (first + page - 1) / page * page, end = (first + bytes) / page * page;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, advice);
}
#endif

}  // namespace

void provide_pages(void* memory, size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    constexpr size_t kLargePage = 2 << 20, kFewLarge = 4 << 20;
    if (bytes >= kFewLarge) advise(memory, bytes, kLargePage, MADV_HUGEPAGE);
    advise(memory, bytes, uintptr_t(sysconf(_SC_PAGESIZE)), MADV_POPULATE_WRITE);
#else
    (void)memory, (void)bytes;
#endif
}

}  // namespace kinora
