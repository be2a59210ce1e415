// runtime/base/parallel.cpp: parallel_for on oneTBB.
#include "runtime/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "runtime/base/check.h"

namespace kinora {

namespace {

int g_threads = 0;  // 0: not set, the machine's count
std::optional<tbb::global_control> g_limit;
std::unique_ptr<tbb::task_arena> g_arena;
thread_local bool t_serial = false;

tbb::task_arena& arena() {
    if (!g_arena) g_arena = std::make_unique<tbb::task_arena>(thread_count());
    return *g_arena;
}

}  // namespace

void set_thread_count(int n) {
    CHECK_GE(n, 1);
    g_threads = n;
    g_arena.reset();
    g_limit.emplace(tbb::global_control::max_allowed_parallelism, size_t(n));
}

int thread_count() {
    if (g_threads == 0) g_threads = std::max(1, int(std::thread::hardware_concurrency()));
    return g_threads;
}

int thread_index() {
    int index = tbb::this_task_arena::current_thread_index();
    return index == tbb::task_arena::not_initialized ? 0 : std::min(index, thread_count() - 1);
}

SerialScope::SerialScope() : before_(std::exchange(t_serial, true)) {}
SerialScope::~SerialScope() {
    t_serial = before_;
}

void parallel_for(size_t first, size_t last, size_t grain, FunctionRef<void(size_t, size_t)> body) {
    if (first >= last) return;
    if (t_serial || thread_count() == 1 || last - first <= grain) return body(first, last);
    arena().execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<size_t>(first, last, std::max<size_t>(grain, 1)),
            [&](const tbb::blocked_range<size_t>& range) { body(range.begin(), range.end()); });
    });
}

}  // namespace kinora
