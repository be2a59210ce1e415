// tests/runtime/allocations_of_ours.h: counts heap allocations that this program's own code makes.
#pragma once

#include <cstddef>
#include <string>

// Starts counting calls of operator new that are made by this program and its C++ library, not
// in Embree or TBB; those of all threads together.
void watch_allocations();
// Stops, and says how many there were.
size_t allocations_of_ours();
// The code address of the first, for addr2line.
std::string first_allocation_of_ours();
