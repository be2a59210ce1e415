// runtime/base/stats.cpp: what the operating system knows of this process.
#include "runtime/base/stats.h"

#include <sys/resource.h>

namespace kinora {

size_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return size_t(usage.ru_maxrss) * 1024;
}

}  // namespace kinora
