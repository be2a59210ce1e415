// runtime/picture/shading/rays/gather_records.h: the records of a gather statement, and what of its
// rays is known before they are shot.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jit/ir/kernel_call.h"
#include "rsl/lower/lower.h"
#include "runtime/base/arena.h"
#include "runtime/base/math.h"

namespace kinora {

using GatherResult = rsl::LoweredShader::GatherResult;

// The records of one gather statement at one depth; kept from frame to frame.
struct GatherMemory {
    std::vector<float> values;
    std::vector<const float*> columns;
    std::vector<jit::Record> records;
};

// One statement's records: columns [record][state, results...][lane].
class GatherRecords {
  public:
    GatherRecords(GatherMemory& memory, int count, int width, size_t first)
        : memory_(memory), width_(width) {
        size_t columns = size_t(count) * size_t(width);
        memory.values.assign(columns * jit::kMaxLanes, 0.0f);
        memory.columns.resize(columns);
        memory.records.resize(size_t(count));
        for (size_t c = 0; c < columns; ++c)  // read at the grid's point: a part starts before it
            memory.columns[c] = memory.values.data() + c * jit::kMaxLanes - first;
        for (size_t r = 0; r < size_t(count); ++r)
            memory.records[r] = {memory.columns.data() + r * size_t(width), nullptr};
    }
    float& at(uint32_t record, int column, int lane) {
        return memory_.values[(size_t(record) * size_t(width_) + size_t(column)) * jit::kMaxLanes +
                              size_t(lane)];
    }
    // Makes record `to` of a lane what record `from` is.
    void copy(uint32_t from, uint32_t to, int lane) {
        for (int column = 0; column < width_; ++column)
            at(to, column, lane) = at(from, column, lane);
    }
    void set(uint32_t record, int column, int lane, vec3 v) {
        for (int k = 0; k < 3; ++k) at(record, column + k, lane) = v[k];
    }

  private:
    GatherMemory& memory_;
    int width_;
};

// Columns of a record.
int record_width(std::span<const GatherResult> results);

// Results that are known before the ray is shot.
enum class RayFact : uint8_t { Origin, Direction, Length, MapColor, SolidAngle };
struct RayColumn {
    RayFact fact;
    int column;
};
// Those of the results that are such.
std::span<const RayColumn> ray_columns(std::span<const GatherResult> results, Arena& arena);

// A ray as its record shows it, in current space.
struct RayFacts {
    vec3 origin, direction;
    float length;  // until it is known to end earlier
    vec3 map_color{0.0f};
    float solid_angle = 0;  // that it stands for
};
void record_ray(GatherRecords& records, std::span<const RayColumn> columns, uint32_t record,
                int lane, const RayFacts& facts);

}  // namespace kinora
