// runtime/programs/render/stop_signal.h: how a run is stopped from outside.
#pragma once

#include <atomic>

namespace kinora {

// Set by the first signal, to its number; the frame under way is dropped at its next rays. A second
// signal stops at once, and so does a shader that takes some seconds more.
extern std::atomic<int> g_signal;

// From here on a signal lets go of the frame under way; before, it just ends the process.
void catch_signals();

}  // namespace kinora
