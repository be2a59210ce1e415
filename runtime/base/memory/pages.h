// runtime/base/memory/pages.h: pages of memory that will be used for certain.
#pragma once

#include <cstddef>

namespace kinora {

// Has the system provide the whole pages of some memory at once. It would provide each when it is
// first written, by an interrupt: 13 instead of 0.7 us a page on a virtual machine. What is there
// stays.
void provide_pages(void* memory, size_t bytes);

}  // namespace kinora
