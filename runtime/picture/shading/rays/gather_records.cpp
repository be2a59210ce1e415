// runtime/picture/shading/rays/gather_records.cpp: what is known of a gather's rays goes into its
// records.
#include "runtime/picture/shading/rays/gather_records.h"

#include <string_view>

namespace kinora {

namespace {

struct RayFactRow {
    std::string_view name;
    RayFact fact;
};
constexpr RayFactRow kRayFacts[] = {
    {"ray:origin", RayFact::Origin},          {"ray:direction", RayFact::Direction},
    {"ray:length", RayFact::Length},          {"environment:direction", RayFact::Direction},
    {"environment:color", RayFact::MapColor}, {"environment:solidangle", RayFact::SolidAngle},
};

}  // namespace

std::span<const RayColumn> ray_columns(std::span<const GatherResult> results, Arena& arena) {
    std::span<RayColumn> found = arena.allocate_span<RayColumn>(results.size());
    size_t count = 0;
    int column = rsl::kGatherResults;
    for (const GatherResult& result : results) {
        for (const RayFactRow& row : kRayFacts)
            if (row.name == result.name) found[count++] = {row.fact, column};
        column += rsl::component_count(result.type);
    }
    return found.first(count);
}

int record_width(std::span<const GatherResult> results) {
    int width = rsl::kGatherResults;
    for (const GatherResult& result : results) width += rsl::component_count(result.type);
    return width;
}

void record_ray(GatherRecords& records, std::span<const RayColumn> columns, uint32_t record,
                int lane, const RayFacts& facts) {
    for (const RayColumn& c : columns) switch (c.fact) {
            case RayFact::Origin:
                records.set(record, c.column, lane, facts.origin);
                break;
            case RayFact::Direction:
                records.set(record, c.column, lane, facts.direction);
                break;
            case RayFact::Length:
                records.at(record, c.column, lane) = facts.length;
                break;
            case RayFact::MapColor:
                records.set(record, c.column, lane, facts.map_color);
                break;
            case RayFact::SolidAngle:
                records.at(record, c.column, lane) = facts.solid_angle;
                break;
        }
}

}  // namespace kinora
