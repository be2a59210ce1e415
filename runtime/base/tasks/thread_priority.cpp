// runtime/base/tasks/thread_priority.cpp: Linux has a nice value for each thread.
#include "runtime/base/tasks/thread_priority.h"

#include <sys/resource.h>

namespace kinora {

void lower_thread_priority() {
    constexpr int kNice = 5;
    setpriority(PRIO_PROCESS, 0, kNice);  // 0: this thread, not the process
}

}  // namespace kinora
