// runtime/picture/shading/rays/kinds.cpp: the table of the kinds of rays.
#include "runtime/picture/shading/rays/kinds.h"

#include "raytrace/accel.h"

namespace kinora {

namespace {

constexpr uint32_t kReflected = raytrace::mask_of_viewer(raytrace::kSeenByReflections);
constexpr uint32_t kDiffuse = raytrace::mask_of_viewer(raytrace::kSeenByDiffuse);
constexpr uint32_t kShadowing = raytrace::mask_of_viewer(raytrace::kSeenByShadows);

constexpr RayKindRow kRayKinds[] = {
    {RayKind::Trace, "trace", RayType::Specular, kReflected, RayBudget::Share, RayFinds::Color,
     true},
    {RayKind::Transmission, "transmission", RayType::Transmission, kShadowing, RayBudget::Samples,
     RayFinds::Passing, false},
    {RayKind::Occlusion, "occlusion", RayType::Transmission, kDiffuse, RayBudget::Samples,
     RayFinds::Passing, false},
    {RayKind::Indirect, "indirectdiffuse", RayType::Diffuse, kDiffuse, RayBudget::Fit,
     RayFinds::Color, true},
    {RayKind::Gather, "gather", RayType::Specular, kReflected, RayBudget::Share, RayFinds::Hit,
     false},
    {RayKind::Lamp, "", RayType::Transmission, kShadowing, RayBudget::Free, RayFinds::Passing,
     false},
};

}  // namespace

std::span<const RayKindRow> ray_kinds() {
    return kRayKinds;
}

RayTag sent_tag(const RayTag& from, const RayKindRow& row, int32_t label) {
    RayTag tag = from;
    tag.type = row.type;
    if (row.finds == RayFinds::Passing) return tag;  // which is no further ray of a path
    tag.label = label;
    (row.type == RayType::Diffuse ? tag.diffuse : tag.specular) += 1;
    return tag;
}

int samples_at(const RayTag& tag, int asked) {
    if (tag.most_samples == 0 || asked <= int(tag.most_samples)) return asked;
    int fitting = int(tag.most_samples);
    while (asked % fitting != 0) --fitting;
    return fitting;
}

bool is_too_deep(const RayKindRow& row, const RayDepth& at) {
    if (row.finds == RayFinds::Passing) return false;
    return at.depth >= at.most_depth ||
           (row.type == RayType::Diffuse && at.diffuse >= at.most_diffuse);
}

}  // namespace kinora
