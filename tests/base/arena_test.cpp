// tests/base/arena_test.cpp: memory handed out in order and given back all at once.
#include "runtime/base/arena.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "runtime/base/memory/pages.h"

namespace kinora {
namespace {

TEST(Arena, HandsOutAlignedMemoryThatDoesNotOverlap) {
    Arena arena(1024);
    std::vector<std::span<uint8_t>> spans;
    for (size_t size : {1, 63, 64, 65, 1000, 0, 5000, 7}) {
        spans.push_back(arena.allocate_span<uint8_t>(size));
        EXPECT_EQ(reinterpret_cast<uintptr_t>(spans.back().data()) % 64, 0u);
        std::memset(spans.back().data(), int(spans.size()), size);
    }
    for (size_t i = 0; i < spans.size(); ++i)
        for (uint8_t byte : spans[i]) ASSERT_EQ(byte, i + 1);
}

TEST(Arena, AllocatesNoMoreOnceItHasMetItsLargestFrame) {
    Arena arena(256);
    auto frame = [&] {
        for (size_t size : {100, 300, 200, 10, 900}) arena.allocate(size);
        arena.reset();
    };
    frame();
    size_t capacity = arena.capacity();
    for (int i = 0; i < 10; ++i) frame();
    EXPECT_EQ(arena.capacity(), capacity);
}

TEST(Arena, ReleaseGivesBackWhatCameAfterTheMark) {
    Arena arena(256);
    auto kept = arena.allocate_span<int>(3);
    kept[0] = 17;
    Arena::Mark mark = arena.mark();
    void* first = arena.allocate(100);
    arena.allocate(1000);  // another block
    arena.release(mark);
    EXPECT_EQ(arena.allocate(100), first);
    EXPECT_EQ(kept[0], 17);
}

TEST(Pages, ThatAreProvidedKeepWhatIsThere) {
    std::vector<unsigned char> bytes(5 << 16);
    for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = (unsigned char)(i * 7);
    for (size_t first : {size_t(0), size_t(1), size_t(4095), size_t(4096)})
        for (size_t count : {size_t(0), size_t(1), size_t(4096), bytes.size() - first})
            provide_pages(bytes.data() + first, count);
    for (size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], (unsigned char)(i * 7)) << i;
}

}  // namespace
}  // namespace kinora
