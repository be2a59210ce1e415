// raytrace/zeroed_vector.h: large buffers of which a small frame uses little.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace kinora {

// Memory that reads as 0 and that the system provides page by page when it is first written:
// calloc() does not write to fresh pages, and elements made without a value keep what is there.
template <class T>
struct ZeroedAllocator {
    static_assert(std::is_trivially_copyable_v<T>);
    using value_type = T;
    ZeroedAllocator() = default;
    template <class U>
    ZeroedAllocator(const ZeroedAllocator<U>&) {}
    T* allocate(size_t count) {
        void* memory = std::calloc(count, sizeof(T));
        if (!memory) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, size_t) { std::free(memory); }
    template <class U, class... Args>
    void construct(U* at, Args&&... args) {
        if constexpr (sizeof...(Args) > 0) ::new (at) U(std::forward<Args>(args)...);
    }
    bool operator==(const ZeroedAllocator&) const { return true; }
};

// Of numbers and plain structs whose first value is all zero bits. An element that resize() adds
// is 0 if it was never there; one that comes back has its old value.
template <class T>
using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;

}  // namespace kinora
