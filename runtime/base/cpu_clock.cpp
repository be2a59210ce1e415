// runtime/base/cpu_clock.cpp: POSIX clocks of CPU time.
#include "runtime/base/cpu_clock.h"

#include <ctime>

namespace kinora {

namespace {

double clock_ms(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

}  // namespace

double process_cpu_ms() {
    return clock_ms(CLOCK_PROCESS_CPUTIME_ID);
}

double thread_cpu_ms() {
    return clock_ms(CLOCK_THREAD_CPUTIME_ID);
}

}  // namespace kinora
