// runtime/base/parallel.cpp: parallel_for, whose threads a module has
// (runtime/base/tasks/tasks_module.h).
#include "runtime/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <utility>

#include "runtime/base/check.h"
#include "runtime/base/shared_library.h"
#include "runtime/base/tasks/tasks_module.h"
#include "runtime/base/tasks/usable_cores.h"

namespace kinora {

namespace {

struct TasksModule : SharedLibrary {
    TasksModule()
        : SharedLibrary(module_path("libkinora_tasks.so"), "loops are shared among threads",
                        "libtbb12") {}

    KINORA_FUNCTION(kinora_limit_threads);
    KINORA_FUNCTION(kinora_thread_index);
    KINORA_FUNCTION(kinora_parallel_for);
};

std::mutex g_changing;                              // of the two below
std::atomic<int> g_threads = 0;                     // 0: not set, then usable_cores()
std::atomic<const TasksModule*> g_tasks = nullptr;  // null: not opened
thread_local bool t_serial = false;

const TasksModule* open_tasks() {
    const TasksModule& tasks = opened<TasksModule>();
    const std::lock_guard lock(g_changing);
    if (tasks.error().empty()) {
        tasks.kinora_limit_threads(thread_count());
        g_tasks = &tasks;
    } else {
        std::fprintf(stderr, "kinora: %s; one thread works\n", tasks.error().c_str());
        g_threads = 1;
    }
    return g_tasks;
}

// Opened by the first call; null where it cannot be.
const TasksModule* tasks() {
    static const TasksModule* const opened_once = open_tasks();
    return opened_once;
}

}  // namespace

void set_thread_count(int n) {
    CHECK_GE(n, 1);
    const std::lock_guard lock(g_changing);
    if (g_threads.exchange(n) == n) return;  // loops of others may run
    if (const TasksModule* module = g_tasks) module->kinora_limit_threads(n);
}

int thread_count() {
    if (g_threads == 0) g_threads = usable_cores();
    return g_threads;
}

int thread_index() {
    const TasksModule* module = g_tasks;
    return module ? std::clamp(module->kinora_thread_index(), 0, thread_count() - 1) : 0;
}

void open_task_scheduler() {
    tasks();
}

SerialScope::SerialScope() : before_(std::exchange(t_serial, true)) {}
SerialScope::~SerialScope() {
    t_serial = before_;
}

void parallel_for(size_t first, size_t last, size_t grain, LoopBody body) {
    if (first >= last) return;
    const bool alone = t_serial || thread_count() == 1 || last - first <= grain;
    const TasksModule* module = alone ? nullptr : tasks();
    if (!module) return body(first, last);
    module->kinora_parallel_for(first, last, std::max<size_t>(grain, 1), &body);
}

}  // namespace kinora
