// runtime/shading/grid.h: a shading grid: the points of some hits that wear one look, as columns.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "jit/ir/kernel_call.h"
#include "raytrace/wavefront.h"
#include "runtime/shading/shader_instance.h"
#include "runtime/shading/shading_frame.h"

namespace kinora {

class LightShadows;
class RayCollector;

inline constexpr size_t kGridPoints = 1024;  // one grid at most; its columns stay in the L2 cache
inline constexpr size_t kRecordSets = 256;   // handles a grid may hold at once
inline constexpr size_t kGatherSets = kRecordSets - rsl::kGatherLevels;  // the last ones

using jit::padded;

// How the rays came about that see a grid's points.
enum class RayKind : uint8_t { Camera, Specular, Diffuse, Transmission };
struct RayTag {
    RayKind kind = RayKind::Camera;
    int32_t label = 0;                   // interned; of trace or gather
    uint32_t specular = 0, diffuse = 0;  // rays of each kind on the way from the eye
};

// The rays that a point has shot, and how the ray that sees it goes on.
struct PointRays {
    uint32_t shot = 0;     // those of points that the ray has passed included
    uint32_t refused = 0;  // asked for, and too deep or of too small a share
    bool ended = false;    // its budget is spent: the loops that shoot rays end
    bool reflects = false;
    float onward = 1;  // raytrace::Passage::onward
};

// Columns are rows of padded(count) floats in an arena; null where nobody asked. "current" space.
// Lives on the stack of whatever shades it; services see it through GridHost.
struct Grid {
    Grid(const ShadingFrame& f, ThreadMemory& m, const raytrace::HitBatch& h,
         std::span<const uint32_t> p, const ShaderInstance* l)
        : frame(f), memory(m), scene(f.scene), pose(f.pose), hits(h), points(p), look(l) {}
    Grid(const Grid&) = delete;

    const ShadingFrame& frame;
    ThreadMemory& memory;
    const Scene& scene;
    const Pose& pose;
    const raytrace::HitBatch& hits;
    std::span<const uint32_t> points;  // indices into hits
    const ShaderInstance* look;
    bool dense = false;      // hits one behind the other
    bool ascending = false;  // their numbers grow
    uint32_t depth = 0;
    std::span<float*> columns;  // by Column
    // Of each point: raytrace::kUnitNormals, kOneNormal or 0, which is always right. With N only.
    std::span<uint32_t> normals;
    std::span<jit::RecordSet> record_sets;  // [0]: lights at P
    uint32_t next_record_set = 1;
    int32_t record_group = -1;        // first lane of the group that lights_at served last
    Arena::Mark record_mark{};        // where its records begin
    uint32_t record_calls = 0;        // of the group
    LightShadows* shadows = nullptr;  // null inside opacity kernels, which shoot no rays
    RayTag ray;
    // Of each point that may, calls that shot rays which shade what they meet.
    std::span<uint16_t> calls;
    // Of each point, or none where no kernel shoots rays; a light's are those of the points it
    // lights.
    std::span<PointRays> rays;
    bool goes_on = false;               // the rays that see the points may go on behind them
    RayCollector* collector = nullptr;  // of rays that wait for those of other points
    // Whose parameters surface() and displacement() show a light: of the surface it lights; null
    // in lights and volumes: each point's own surface.
    const ShaderInstance* surface = nullptr;
    const Grid* lit = nullptr;  // a light's: the grid of the surface
    size_t lit_first = 0;       // whose point that of point 0 is

    size_t count() const { return points.size(); }

    // Something is drawn at random for its points (FirstHits). A light's are those of the surface
    // it lights.
    void note_random() const {
        const Grid& seen = lit ? *lit : *this;
        if (frame.insight.first) frame.insight.first->note_random(seen.look->index, seen.depth);
    }
};

// Takes rows for the wanted columns that are still null.
void want_columns(Grid& grid, std::span<const uint16_t> wanted);
void want_triple(Grid& grid, uint16_t first);

// Fills every non-null column from the hits.
void gather(Grid& grid);

// Cofactor of the linear part: takes normals along (docs/numerics.md#geometry), the mirror's sign
// taken out; its largest entry 1, since squares of lengths are floats.
mat3 normal_matrix(const dmat4& m, bool mirrored);

// Number `component` of ShaderInstance::varying[which] of the look that a hit's surface wears: the
// bits that its column would have.
float varying_at(const Scene& scene, const Pose& pose, const raytrace::HitBatch& hits, uint32_t hit,
                 size_t which, uint32_t component);

}  // namespace kinora
