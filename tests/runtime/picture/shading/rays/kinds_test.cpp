// tests/runtime/picture/shading/rays/kinds_test.cpp: the table of the kinds of rays.
#include "runtime/picture/shading/rays/kinds.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "raytrace/accel.h"
#include "rsl/model/renderer_services.h"

namespace kinora {
namespace {

TEST(RayKinds, RowsAreInTheOrderOfTheirNumbers) {
    ASSERT_EQ(ray_kinds().size(), size_t(RayKind::Lamp) + 1);
    for (size_t k = 0; k < ray_kinds().size(); ++k) EXPECT_EQ(size_t(ray_kinds()[k].kind), k);
}

TEST(RayKinds, NameServicesThatShadersCall) {
    std::set<std::string_view> names;
    for (const RayKindRow& row : ray_kinds()) {
        EXPECT_TRUE(names.insert(row.service).second) << row.service;
        EXPECT_EQ(row.kind == RayKind::Lamp, row.service.empty());
        if (!row.service.empty()) {
            EXPECT_TRUE(rsl::find_service(row.service)) << row.service;
        }
    }
}

// What waits for the second run of its kernel must be a color: the first run saw none.
TEST(RayKinds, OnlyColorsAreNoted) {
    for (const RayKindRow& row : ray_kinds())
        EXPECT_TRUE(!row.noted || row.finds == RayFinds::Color) << row.service;
}

TEST(RayKinds, EveryRayMaySeeSomething) {
    for (const RayKindRow& row : ray_kinds()) EXPECT_TRUE(row.sees & raytrace::kMaskAll);
}

TEST(RayKinds, TagsCountTheRaysOfAPath) {
    RayTag at{RayType::Specular, 7, 2, 1};
    EXPECT_EQ(sent_tag(at, row_of(RayKind::Trace), 9), (RayTag{RayType::Specular, 9, 3, 1}));
    EXPECT_EQ(sent_tag(at, row_of(RayKind::Gather), 0), (RayTag{RayType::Specular, 0, 3, 1}));
    EXPECT_EQ(sent_tag(at, row_of(RayKind::Indirect), 0), (RayTag{RayType::Diffuse, 0, 2, 2}));
    for (RayKind kind : {RayKind::Transmission, RayKind::Occlusion, RayKind::Lamp})
        EXPECT_EQ(sent_tag(at, row_of(kind), 9), (RayTag{RayType::Transmission, 7, 2, 1}));
}

TEST(RayKinds, DepthForbidsWhatIsShaded) {
    const RayDepth last{4, 1, 4, 2}, last_bounce{2, 2, 4, 2}, within{2, 1, 4, 2};
    for (const RayKindRow& row : ray_kinds()) {
        EXPECT_EQ(is_too_deep(row, last), row.finds != RayFinds::Passing) << row.service;
        EXPECT_EQ(is_too_deep(row, last_bounce), row.kind == RayKind::Indirect) << row.service;
        EXPECT_FALSE(is_too_deep(row, within)) << row.service;
    }
}

}  // namespace
}  // namespace kinora
