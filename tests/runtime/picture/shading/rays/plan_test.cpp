// tests/runtime/picture/shading/rays/plan_test.cpp: samples of plans; calls that are the same.
#include "runtime/picture/shading/rays/plan.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace kinora {
namespace {

constexpr int kLanes = jit::kMaxLanes;

// A call of two rows in lanes of a mask.
struct Call {
    alignas(64) float args[2 * kLanes] = {};
    jit::ServiceCall call{nullptr, args, nullptr, 0, 0, kLanes};
    explicit Call(uint32_t mask) { call.mask = mask; }
};

RayPlan plan_of(std::vector<std::pair<int, int>> lanes) {
    RayPlan plan;
    for (auto [lane, count] : lanes) plan.count[lane] = count, plan.share[lane] = 0.5f;
    return plan;
}

TEST(PlannedSamples, ComeOnceEachAndInOrderWhateverTheRoom) {
    const RayPlan plan = plan_of({{0, 3}, {1, 2}, {4, 40}, {15, 1}});
    Call call(0xfffd);  // lane 1 does not ask
    const Lanes lanes(call.call);
    std::vector<std::pair<int, uint32_t>> want;
    for (int lane : {0, 4, 15})
        for (uint32_t k = 0; k < uint32_t(plan.count[lane]); ++k) want.push_back({lane, k});
    EXPECT_EQ(PlannedSamples(lanes, plan).count(), want.size());
    for (size_t room : {1u, 2u, 3u, 16u, 43u, 44u, 1000u}) {
        PlannedSamples samples(lanes, plan);
        std::vector<std::pair<int, uint32_t>> got;
        std::vector<uint8_t> lane(room);
        std::vector<uint32_t> number(room);
        while (const size_t n = samples.take(lane.data(), number.data(), room)) {
            EXPECT_TRUE(n == room || got.size() + n == want.size());
            for (size_t i = 0; i < n; ++i) got.push_back({lane[i], number[i]});
        }
        EXPECT_EQ(got, want) << room;
    }
}

TEST(PlannedSamples, NoneOfAnEmptyPlan) {
    Call call(0xffff);
    const Lanes lanes(call.call);
    uint8_t lane[4];
    uint32_t number[4];
    EXPECT_FALSE(RayPlan{}.any());
    EXPECT_EQ(PlannedSamples(lanes, {}).take(lane, number, 4), 0u);
}

TEST(SameCall, LanesThatDoNotAskDoNotCount) {
    Call a(1 << 3), b(1 << 3);
    EXPECT_TRUE(same_arguments(a.args, b.args, 2, a.call.mask));
    b.args[kLanes + 5] = 1;
    EXPECT_TRUE(same_arguments(a.args, b.args, 2, a.call.mask));
    b.args[kLanes + 3] = -0.0f;  // bit for bit
    EXPECT_FALSE(same_arguments(a.args, b.args, 2, a.call.mask));
    EXPECT_TRUE(same_arguments(a.args, b.args, 1, a.call.mask));
}

TEST(SameCall, LanesWithoutRaysDoNotCount) {
    const RayPlan a = plan_of({{2, 4}, {7, 0}});
    RayPlan b = a;
    EXPECT_TRUE(same_rays(a, b));
    b.share[7] = 0.25f;
    EXPECT_TRUE(same_rays(a, b));
    b.share[2] = 0.25f;
    EXPECT_FALSE(same_rays(a, b));
    b = a;
    b.way[2].weight = 0.5f;
    EXPECT_FALSE(same_rays(a, b));
    b = a;
    b.count[2] = 5;
    EXPECT_FALSE(same_rays(a, b));
}

TEST(Lanes, TextsAreVisitedOnceEach) {
    Call call(0x0f);
    for (int lane = 0; lane < 4; ++lane) call.args[lane] = jit::float_of(lane % 2 ? 8 : 9);
    std::vector<std::pair<int, uint32_t>> seen;
    Lanes(call.call).for_each_text(0, [&](const Lanes& alike) {
        seen.push_back({alike.integer(0, alike.first()), alike.mask()});
    });
    EXPECT_EQ(seen, (std::vector<std::pair<int, uint32_t>>{{9, 0x5}, {8, 0xa}}));
}

}  // namespace
}  // namespace kinora
