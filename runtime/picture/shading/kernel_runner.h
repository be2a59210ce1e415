// runtime/picture/shading/kernel_runner.h: runs kernels over grids and collects the faults they
// report.
#pragma once

#include <span>
#include <vector>

#include "rsl/model/globals.h"
#include "runtime/base/diagnostic.h"
#include "runtime/base/parallel.h"
#include "runtime/picture/shading/frame/frame.h"
#include "runtime/picture/shading/grid.h"

namespace kinora {

class KernelHost;
struct GridServices;

class KernelRunner {
  public:
    // `services` answer the kernels' calls.
    KernelRunner(const ShadingFrame& frame, const GridServices& services)
        : frame_(frame), services_(services) {}

    // Forgets all faults.
    void begin_frame(size_t threads);
    // One finding for each source line that reported a fault.
    void report_faults(Diagnostics& diagnostics) const;

    // Gives the grid what a kernel of its look takes, its columns still null. `ray`: of its hits.
    void prepare(Grid& grid, const RayTag& ray) const;
    // The accounts of the grid's points as they are before its kernel runs.
    void start_accounts(Grid& grid) const;
    // `run` runs kernels at the grid's points for what their calls of services note. Of the
    // accounts nothing stays.
    void run_noting(Grid& grid, FunctionRef<void()> run) const;
    // What the look's kernel gives without lights and rays; it prints and bakes nothing.
    std::span<float*> run_in_the_dark(Grid& grid) const;
    // What the look's kernel gives in those lights, without rays; it prints and bakes nothing. The
    // grid's own lights and accounts stay.
    std::span<float*> run_relit(Grid& grid, const jit::RecordSet& lights) const;
    // What a kernel of the look gives in some of the light that the grid's tape and its records
    // have; it prints and bakes nothing.
    std::span<float*> run_part(const BoundKernel& bound, Grid& grid, const LightPart& part) const;
    // Runs a kernel of the grid's look; its output rows, from the thread's arena.
    std::span<float*> run(const BoundKernel& bound, Grid& grid);

  private:
    // In those lights; what it faults is not told. The grid's own record sets stay.
    void run_again(const BoundKernel& bound, Grid& grid, KernelHost& host,
                   std::span<float* const> out, const jit::RecordSet& lights) const;

    const ShadingFrame& frame_;
    const GridServices& services_;
    std::vector<std::vector<std::vector<uint8_t>>> faults_;  // [thread][look and kernel][site]
};

// Whether the kernel calls the service that sends such rays.
bool calls_service(const BoundKernel& kernel, RayKind kind);
// Whether a kernel of the look calls services that count rays (PointRays).
bool shoots_rays(const ShaderInstance& look);

// The hits of one look, in their order.
struct LookRun {
    const ShaderInstance* look;
    std::span<uint32_t> hits;
    bool ascending;  // their numbers are
};
// All of a batch's, by the number of the look; from the arena. The cost does not depend on how many
// looks a scene has, but where there are more hits than looks.
std::span<const LookRun> runs_by_look(const ShadingFrame& frame, const raytrace::HitBatch& hits,
                                      Arena& arena);

// Memory for the colours of that many hits.
raytrace::ShadeResult take_colors(Arena& arena, size_t count);

// The three outputs of a kernel that a global is, null where it has none.
void find_color(const jit::Kernel& kernel, std::span<float* const> out, rsl::Global id,
                float* color[3]);

}  // namespace kinora
