// runtime/base/memory/pages.h: pages of memory that will be used for certain.
#pragma once

#include <cstddef>
#include <vector>

namespace kinora {

// Has the system provide the whole pages of some memory at once. It would provide each when it is
// first written, by an interrupt: 13 instead of 0.7 us a page on a virtual machine. From some
// megabytes on they are large pages where the system has them. What is there stays.
void provide_pages(void* memory, size_t bytes);

// Room for so many, with its pages: before a long vector is filled.
template <class T>
void reserve_pages(std::vector<T>& vector, size_t count) {
    if (count <= vector.capacity()) return;
    vector.reserve(count);
    provide_pages(vector.data(), count * sizeof(T));
}
template <class T>
void resize_pages(std::vector<T>& vector, size_t count, const T& value = T()) {
    reserve_pages(vector, count);
    vector.resize(count, value);
}

}  // namespace kinora
