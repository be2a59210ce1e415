// raytrace/tiles/integrator.h: from a camera to a film: tiles, layers, and the surfaces' shading
// between.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "raytrace/accel.h"
#include "raytrace/camera.h"
#include "raytrace/film.h"
#include "raytrace/pixels/filter_grid.h"
#include "raytrace/wavefront.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stage_clock.h"

namespace kinora::raytrace {

struct FilterTable;  // raytrace/pixels/pixels.h

// The looks of surfaces, implemented by the runtime. shade() is called by many threads at once with
// dense batches (up to IntegratorSettings::chunk_rays hits of one tile, not sorted); it may trace
// rays through the Accel on its own thread but starts no task. thread: 0 <= thread <
// thread_count().
class SurfaceShading {
  public:
    virtual ~SurfaceShading() = default;
    virtual void shade(const HitBatch& hits, int thread, ShadeResult& result) = 0;
    // Whether any shader reads the footprints of hits (HitBatch).
    virtual bool reads_footprints() const { return true; }
    // How far rays that meet nothing are to be shaded, from their last surface; 0: not at all.
    virtual float miss_distance() const { return 0; }
    // Colour and opacity of what lies along rays that meet nothing (see missed()).
    virtual void shade_misses(const HitBatch& /*ends*/, int /*thread*/, ShadeResult& /*result*/) {}
    // RayBatch::medium of a ray that goes on behind hit k.
    virtual uint32_t medium_behind(const HitBatch& /*hits*/, size_t /*k*/) const { return 0; }
    // Whether hit k shows a hole in the picture, and whether any hit may.
    virtual bool has_mattes() const { return false; }
    virtual bool is_matte(const HitBatch& /*hits*/, size_t /*k*/) const { return false; }
    // Nobody waits for the picture any more: what is still asked for may be anything.
    virtual bool stopped() const { return false; }
    // After the last shade() of a tile, on the same thread.
    virtual void end_tile(int /*thread*/) {}
};

struct IntegratorSettings {
    int samples_per_pixel = 1;            // 1: the pixel's centre; more: stratified over the filter
    const PixelFilter* filter = nullptr;  // nullptr: box
    double filter_width = 0;              // pixels; 0: the filter's own
    std::shared_ptr<const FilterGrid> filter_grid = nullptr;  // instead of both
    uint32_t seed = 0;                                        // of the frame
    int max_layers = 256;            // surfaces one ray may pass where Oi < 1
    std::optional<vec3> background;  // nothing: transparent
    NanPolicy nan = NanPolicy::Zero;
    float opaque_above = 0.9999f;  // a ray ends when its opacity exceeds this in all components
    int tile = 64;                 // pixels, a multiple of 4; less where there are many samples
    size_t chunk_rays = 8192;      // rays of a tile traced and shaded at once; >= tile * tile
};

struct IntegratorCounters {
    TraceCounters trace;  // camera rays and their continuations; shade()'s own are not here
    uint64_t shading_points = 0;
    uint64_t non_finite = 0;               // results replaced by IntegratorSettings::nan
    uint32_t non_finite_geometry = kNone;  // Geometry::id of the lowest row that gave one
    uint64_t too_deep = 0;  // rays that met more than IntegratorSettings::max_layers surfaces
    StageTicks stages;      // summed over threads
    void operator+=(const IntegratorCounters& o);
};

// Memory reused from frame to frame: after the first frame of a size and a number of samples,
// integrate() allocates nothing.
class IntegratorScratch {
  public:
    IntegratorScratch();
    ~IntegratorScratch();
    struct Thread;
    std::vector<std::unique_ptr<Thread>> threads;
    std::unique_ptr<FilterTable> filter;  // made for the first frame of several samples a pixel
    const PixelFilter* filter_row = nullptr;
    double filter_width = -1;
};

// Called after each tile by whichever thread did it, one at a time; done counts up to total. Return
// false to stop: tiles not begun stay as they were.
using Progress = FunctionRef<bool(int done, int total)>;

// Fills the film (resized to the camera's picture if it differs; of a band the rows that it holds).
// For each sample, front to back: C += T Ci, T *= 1 - Oi. The same bits for any number of threads
// and any order of tiles, if shading is so too. Returns false if progress stopped it.
bool integrate(const Accel& accel, const Camera& camera, SurfaceShading& shading, Film& film,
               const IntegratorSettings& settings, IntegratorScratch& scratch,
               IntegratorCounters& counters, const Progress* progress = nullptr);

// What sample `sample` of a pixel of that film gives, as integrate() has it; associated, over no
// background. `film` is not drawn to, but resized as there.
vec4 integrate_sample(const Accel& accel, const Camera& camera, SurfaceShading& shading, Film& film,
                      const IntegratorSettings& settings, IntegratorScratch& scratch, int x, int y,
                      int sample);

}  // namespace kinora::raytrace
