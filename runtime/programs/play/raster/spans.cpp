// runtime/programs/play/raster/spans.cpp: which span kernels this CPU runs.
#include <cstring>

#include "runtime/base/check.h"
#include "runtime/programs/play/raster/raster.h"
#include "runtime/programs/play/raster/span_p.h"

namespace kinora::play {

namespace {

struct Row {
    const SpanKernel* kernel;
    bool (*runs)();
};

constexpr Row kKernels[] = {
#ifdef __x86_64__
    {&kAvx2Spans, [] { return __builtin_cpu_supports("avx2") != 0; }},
#endif
    {&kPortableSpans, [] { return true; }},
};

}  // namespace

const SpanKernel& span_kernel(const char* name) {
    for (const Row& row : kKernels)
        if (row.runs() && (!name || std::strcmp(name, row.kernel->name) == 0)) return *row.kernel;
    CHECK(!"a span kernel of this name that the CPU supports");
    return kPortableSpans;
}

std::vector<std::string> span_kernels() {
    std::vector<std::string> names;
    for (const Row& row : kKernels)
        if (row.runs()) names.push_back(row.kernel->name);
    return names;
}

}  // namespace kinora::play
