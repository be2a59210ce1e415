// runtime/picture/shading/grid.h: a shading grid: the points of some hits that wear one look, as
// columns.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "jit/ir/kernel_call.h"
#include "raytrace/random/series.h"
#include "raytrace/wavefront.h"
#include "runtime/picture/shading/frame/frame.h"
#include "runtime/picture/shading/rays/budget.h"
#include "runtime/picture/shading/rays/kinds.h"
#include "runtime/scene/shaders/picture_points.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

class DirectionNotes;
class LightAnswer;
class LightShadows;
class RayNotes;
struct LightPoints;

inline constexpr size_t kRecordSets = 256;  // handles a grid may hold at once
inline constexpr size_t kGatherSets = kRecordSets - rsl::kGatherLevels;  // the last ones

using jit::padded;

// Its columns are in the thread's arena. Lives on the stack of whatever shades it; services see it
// through GridHost.
struct Grid : PicturePoints {
    Grid(const ShadingFrame& f, ThreadMemory& m, const raytrace::HitBatch& h,
         std::span<const uint32_t> p, const ShaderInstance* l)
        : PicturePoints{f, h, p, l}, frame(f), memory(m), pose(f.pose) {}
    Grid(const Grid&) = delete;

    const ShadingFrame& frame;
    ThreadMemory& memory;
    const Pose& pose;
    bool dense = false;      // hits one behind the other
    bool ascending = false;  // their numbers grow
    // Of each point: raytrace::kUnitNormals, kOneNormal or 0, which is always right. With N only.
    std::span<uint32_t> normals;
    std::span<jit::RecordSet> record_sets;  // [0]: lights at P
    uint32_t next_record_set = 1;
    int32_t record_group = -1;      // first lane of the group that lights_at served last
    Arena::Mark record_mark{};      // where its records begin
    uint32_t record_calls = 0;      // of the group
    LightAnswer* answer = nullptr;  // of the light's kernel that runs, if it has sample methods
    const raytrace::SampleSeries* series = nullptr;  // of the points; null: that of their hits
    const LightPoints* lit_points = nullptr;         // record set 0 is at these
    // By light: how many samples each point has in the records made last; null where it has none.
    std::span<float*> sample_counts;
    LightShadows* shadows = nullptr;  // null inside opacity kernels, which shoot no rays
    // Of each point that may, calls that shot rays which shade what they meet.
    std::span<uint16_t> calls;
    // Of each point, or none where no kernel shoots rays; a light's are those of the points it
    // lights.
    std::span<PointRays> rays;
    bool goes_on = false;                  // the rays that see the points may go on behind them
    RayNotes* notes = nullptr;             // of calls whose rays wait for those of other points
    AnswerTape* tape = nullptr;            // of its kernel's calls, for layers of light
    DirectionNotes* directions = nullptr;  // of calls of samplinglights that wait so, if any do

    // Something is drawn at random for its points (FirstHits). A light's are those of the surface
    // it lights.
    void note_random() const {
        const PicturePoints& seen = of_surface();
        if (frame.insight.first) frame.insight.first->note_random(seen.look->index, seen.depth);
    }
};

// Takes rows for the wanted columns that are still null.
void want_columns(Grid& grid, std::span<const uint16_t> wanted);
void want_triple(Grid& grid, uint16_t first);

// Fills every non-null column from the hits.
void gather(Grid& grid);

}  // namespace kinora
