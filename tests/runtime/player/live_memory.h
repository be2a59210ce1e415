// tests/runtime/player/live_memory.h: bytes that operator new has given out and not got back.
#pragma once

#include <cstddef>

// Unlike mallinfo() it does not count what threads keep for their next allocations, and so is the
// same in each run.
size_t live_memory();
// The most that lived at once since the last call of most_live_memory().
size_t most_live_memory();
