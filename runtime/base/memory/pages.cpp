// runtime/base/memory/pages.cpp: madvise().
#include "runtime/base/memory/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace kinora {

void provide_pages(void* memory, size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    const auto page = uintptr_t(sysconf(_SC_PAGESIZE));
    const auto first = reinterpret_cast<uintptr_t>(memory);
    const uintptr_t begin = (first + page - 1) / page * page, end = (first + bytes) / page * page;
    // Kernels before 5.14 refuse, and pages come one by one.
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_WRITE);
#else
    (void)memory, (void)bytes;
#endif
}

}  // namespace kinora
