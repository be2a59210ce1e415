// runtime/base/tasks/tasks_module.h: the interface of libkinora_tasks.so, which alone links oneTBB
// and is opened by the first loop that several threads run.
#pragma once

#include "runtime/base/parallel.h"

namespace kinora {
using LoopBody = FunctionRef<void(size_t begin, size_t end)>;
}

extern "C" {

// Threads of later loops and of other libraries that use oneTBB, the calling thread included. Not
// while a loop runs.
void kinora_limit_threads(int n);

// Index of the calling thread among the workers, -1 where it is none.
int kinora_thread_index();

// parallel_for of several ranges.
void kinora_parallel_for(size_t first, size_t last, size_t grain, const kinora::LoopBody* body);
}
