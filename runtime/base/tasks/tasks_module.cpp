// runtime/base/tasks/tasks_module.cpp: loops on oneTBB.
#include "runtime/base/tasks/tasks_module.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>
#include <optional>
#if defined(KINORA_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

namespace {

// ThreadSanitizer does not see how oneTBB orders the code before a loop, its parts and the code
// after. This file is not instrumented, since reports of half of oneTBB would be wrong.
#if defined(KINORA_THREAD_SANITIZER)
struct LoopOrder {
    char begin, end;
    LoopOrder() { __tsan_release(&begin); }
    ~LoopOrder() { __tsan_acquire(&end); }
    void part_begins() { __tsan_acquire(&begin); }
    void part_ends() { __tsan_release(&end); }
};
#else
struct LoopOrder {
    static void part_begins() {}
    static void part_ends() {}
};
#endif

std::optional<tbb::global_control> g_limit;
std::unique_ptr<tbb::task_arena> g_arena;

}  // namespace

extern "C" {

void kinora_limit_threads(int n) {
    g_limit.emplace(tbb::global_control::max_allowed_parallelism, size_t(n));
    g_arena = std::make_unique<tbb::task_arena>(n);
}

int kinora_thread_index() {
    const int index = tbb::this_task_arena::current_thread_index();
    return index == tbb::task_arena::not_initialized ? -1 : index;
}

void kinora_parallel_for(size_t first, size_t last, size_t grain, const kinora::LoopBody* body) {
    [[maybe_unused]] LoopOrder order;
    g_arena->execute([&] {
        tbb::parallel_for(tbb::blocked_range<size_t>(first, last, grain),
                          [&](const tbb::blocked_range<size_t>& range) {
                              order.part_begins();
                              (*body)(range.begin(), range.end());
                              order.part_ends();
                          });
    });
}
}
