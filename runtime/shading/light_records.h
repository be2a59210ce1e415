// runtime/shading/light_records.h: lights run once for a grid; their answers become records that
// surface kernels replay (docs/decisions.md#lights-run-once).
#pragma once

#include "runtime/shading/area_light.h"
#include "runtime/shading/kernel_runner.h"

namespace kinora {

// What one statement of a light sends to each of the points.
struct SentLight {
    bool solar = false;
    const float* L[3];           // to the light
    const float* lit = nullptr;  // null: everywhere
    float* Cl[3];
    const LightSamples* samples = nullptr;  // that send it, of a light on geometry
};

// What takes light away on its way.
class LightShadows {
  public:
    virtual ~LightShadows() = default;
    // Leaves in Cl what arrives at each point, at once or when the caller says so.
    virtual void cast(const Grid& grid, const LightPoints& at, const SentLight& light) = 0;
};

class LightRecords {
  public:
    LightRecords(const ShadingFrame& frame, KernelRunner& kernels);
    void begin_frame() { area_lights_.begin_frame(); }
    // Names the lights that shine only against where they look (light_aim.cpp).
    void report_aims(Diagnostics& diagnostics) const;

    // Which of Scene::lights each record of a set is of.
    std::vector<size_t> light_of_records() const;

    // What every grid with lights needs for them.
    void want_columns(Grid& grid) const;
    // The records of a grid's own points, as its set 0. Grid::shadows casts their shadows.
    void run(Grid& grid);
    // The service `lights`: records at other points than the grid's own; their handle.
    int32_t at(Grid& grid, const jit::ServiceCall& call);

  private:
    jit::RecordSet make_records(Grid& grid, LightPoints at);
    // Run a light's kernel; the slot behind its last record.
    jit::Record* plain_records(Grid& grid, const LightPoints& at, size_t light, jit::Record* next);
    jit::Record* area_records(Grid& grid, const LightPoints& at, size_t light, jit::Record* next);
    jit::Record make_record(Grid& grid, const LightPoints& at, const LightOutputs& statement,
                            const LightBinding& binding, std::span<float* const> out,
                            const LightSamples* samples) const;

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
    LightBindings bindings_;
    AreaLights area_lights_;
    size_t record_count_ = 0;  // of one run
    bool need_rng_ = false;
};

}  // namespace kinora
