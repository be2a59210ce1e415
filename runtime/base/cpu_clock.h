// runtime/base/cpu_clock.h: CPU time, which other programs on the machine do not take part in.
#pragma once

namespace kinora {

double process_cpu_ms();  // of all threads since the start
double thread_cpu_ms();   // of this one

}  // namespace kinora
