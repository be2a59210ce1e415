// tests/anim/allocation_count.h: how often this test program has called operator new.
#pragma once

#include <cstddef>

size_t allocation_count();
