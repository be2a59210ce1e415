// runtime/base/tasks/thread_priority.h: threads that give way to others.
#pragma once

namespace kinora {

// The calling thread runs when those that make pictures leave time: about a third as much as one of
// them. It cannot be taken back.
void lower_thread_priority();

}  // namespace kinora
