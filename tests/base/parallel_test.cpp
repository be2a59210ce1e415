// tests/base/parallel_test.cpp: ranges run on the machine's cores.
#include "runtime/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace kinora {
namespace {

class ParallelFor : public testing::TestWithParam<int> {
  protected:
    ParallelFor() : before_(thread_count()) { set_thread_count(GetParam()); }
    ~ParallelFor() override { set_thread_count(before_); }

  private:
    int before_;
};

TEST_P(ParallelFor, VisitsEachIndexOnce) {
    for (size_t last : {0, 1, 7, 1000, 100'003}) {
        std::vector<std::atomic<int>> visits(last);
        parallel_for(0, last, 16, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (size_t i = 0; i < last; ++i) ASSERT_EQ(visits[i], 1) << i;
    }
}

TEST_P(ParallelFor, StartsWhereItIsTold) {
    std::atomic<size_t> sum{0};
    parallel_for(10, 20, 3, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) sum += i;
    });
    EXPECT_EQ(sum, 145u);
    parallel_for(20, 10, 3, [&](size_t, size_t) { ADD_FAILURE(); });
}

TEST_P(ParallelFor, ThreadIndicesStayBelowTheCountAndAreNotShared) {
    std::vector<std::atomic<int>> inside(static_cast<size_t>(thread_count()));
    std::atomic<bool> shared{false};
    parallel_for(0, 2000, 1, [&](size_t, size_t) {
        int index = thread_index();
        ASSERT_GE(index, 0);
        ASSERT_LT(index, thread_count());
        if (++inside[size_t(index)] != 1) shared = true;
        std::this_thread::yield();
        --inside[size_t(index)];
    });
    EXPECT_FALSE(shared);
}

TEST_P(ParallelFor, RunsInlineWhereItsThreadSaysSo) {
    std::thread background([] {
        SerialScope serial;
        std::thread::id own = std::this_thread::get_id();
        size_t done = 0;
        parallel_for(0, 1000, 1, [&](size_t begin, size_t end) {
            EXPECT_EQ(std::this_thread::get_id(), own);
            EXPECT_EQ(thread_index(), 0);
            done += end - begin;
        });
        EXPECT_EQ(done, 1000u);
    });
    background.join();
}

// As where a second player opens its scene while the first one renders.
TEST_P(ParallelFor, TheSameCountMayBeSetWhileLoopsRun) {
    std::atomic<bool> quit = false;
    std::atomic<size_t> visited = 0;
    std::vector<std::thread> others;
    for (int k = 0; k < 3; ++k)
        others.emplace_back([&] {
            while (!quit)
                parallel_for(0, 64, 1, [&](size_t begin, size_t end) {
                    for (size_t i = begin; i < end; ++i) ++visited;
                });
        });
    for (int k = 0; k < 1000; ++k) {
        set_thread_count(GetParam());
        std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    quit = true;
    for (std::thread& other : others) other.join();
    EXPECT_EQ(visited % 64, 0u);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 2, 4));

TEST(FunctionRef, CallsWhatItSees) {
    int calls = 0;
    auto add = [&](int by) { return calls += by; };
    FunctionRef<int(int)> ref = add;
    FunctionRef<int(int)> copy = ref;
    EXPECT_EQ(ref(2), 2);
    EXPECT_EQ(copy(3), 5);
}

}  // namespace
}  // namespace kinora
