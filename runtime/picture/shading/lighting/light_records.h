// runtime/picture/shading/lighting/light_records.h: lights run once for a grid; their answers
// become records that surface kernels replay (docs/decisions.md#lights-run-once).
#pragma once

#include <array>

#include "runtime/picture/lights/light_choice.h"
#include "runtime/picture/lights/light_samples.h"
#include "runtime/picture/lights/unseen_light.h"
#include "runtime/picture/shading/kernel_runner.h"
#include "runtime/picture/shading/lighting/area_light.h"

namespace kinora {

class CountedSamples;
struct ChosenDirections;

// What takes light away on its way.
class LightShadows {
  public:
    virtual ~LightShadows() = default;
    // Leaves in Cl what arrives at each point, at once or when the caller says so.
    virtual void cast(const Grid& grid, const LightPoints& at, const SentLight& light) = 0;
};

// L, where its shadow ray ends, Cl and density of a sample.
using SampleColumnList = std::array<float*, 10>;

class LightRecords {
  public:
    LightRecords(const ShadingFrame& frame, KernelRunner& kernels);
    // `all`: records of lights that reach no point are made too.
    void begin_frame(bool all, ThreadMemory& memory);
    // Whether some loop of the scene's shaders asks for that one of Scene::lights.
    bool asked(size_t light) const { return bindings_.asked(light); }

    // Of a grid of the look: fewer where there are many records, so that all stay in the cache.
    size_t most_points(const ShaderInstance& look) const;
    const LightBindings& bindings() const { return bindings_; }
    const AreaLights& areas() const { return area_lights_; }
    // What every grid with lights needs for them.
    void want_columns(Grid& grid) const;
    // Finds Grid::lit_points, the grid's own points.
    void find_points(Grid& grid);
    // Whether rays of some light wait for those of other grids.
    bool sends_noted_rays(const Grid& grid) const;
    // Runs such lights at the points; from then on their kernels get what the rays see.
    void note_rays(Grid& grid, RayNotes& notes);
    // The records of these points, as set 0. Grid::shadows casts their shadows.
    void run(Grid& grid);
    // The service `lights`: records at other points than the grid's own; their handle.
    int32_t at(Grid& grid, const jit::ServiceCall& call);
    // The service `samplinglights`: what lights with sample methods send from directions.
    int32_t along(Grid& grid, const jit::ServiceCall& call);
    // Whether its calls at the grid's points wait for each other; notes of them, before the kernel
    // runs to say what it asks; their answers, from then on Grid::directions.
    bool notes_directions(const Grid& grid) const;
    void start_directions(Grid& grid) const;
    void answer_directions(Grid& grid);

  private:
    // Records of a grid's points, and what of them comes from somewhere.
    struct Making {
        Grid& grid;
        const LightPoints& at;
        std::span<jit::Record> records;
        std::span<SentLight> sent;
        size_t record_count = 0, sent_count = 0;
        size_t light_begin = 0;  // the first record of the light
        void make_room();
    };
    jit::RecordSet make_records(Grid& grid, const LightPoints& at);
    // Whether nothing of the light arrives at points of a grid, which are within the sphere.
    bool is_dark(const Grid& grid, size_t light, const Sphere& points) const;
    void make_records(Making& making, size_t light);
    void find_present();
    void choose_sampling(ThreadMemory& memory);  // of lights on geometry
    void find_others();
    // Whether points of the look are lit by a few of many lights.
    bool chooses(const ShaderInstance& look) const;
    void chosen_records(Making& making, const LampGroup& group);
    // All that a light's kernel reads, and its run.
    struct LitGrid : Grid {  // the lit points, for the light's kernel
        LitGrid(const Making& making, size_t light);
    };
    void prepare(const Making& making, size_t light, Grid& lit, LightAnswer* answer) const;
    std::span<float*> run_kernel(const Making& making, size_t light, Grid& lit,
                                 LightAnswer* answer);
    void plain_records(Making& making, size_t light);
    void sampled_records(Making& making, size_t light);
    // The k-th sample of a light at each point.
    void sample_record(Making& making, size_t light, const CountedSamples& samples, size_t k,
                       std::span<float* const> out) const;
    // A record of these columns: L, where its shadow ray ends, Cl and density. Messages are among
    // the kernel's outputs.
    void add_sample(Making& making, size_t light, std::span<float* const> out,
                    SampleColumnList sample) const;
    // What one light sends from the directions of samplinglights.
    jit::RecordSet records_along(Grid& grid, const LightPoints& at,
                                 const ChosenDirections& directions);
    void record_along(Making& making, size_t light, const ChosenDirections& directions);
    // Of a light on geometry (area_records.cpp).
    class AreaKernel;
    void area_records(Making& making, size_t light);
    void area_record(Making& making, size_t light, AreaKernel& kernel,
                     const LightOutputs& statement, std::span<float* const> out) const;
    // What lights on geometry send from the directions of samplinglights.
    void lamps_along(Making& making, const ChosenDirections& directions);
    void lamp_along(Making& making, size_t light, const ChosenDirections& directions,
                    const raytrace::RayBatch& rays, const raytrace::HitBatch& hits);
    // Records of solar with an angle: a sample of its cone each, with its share of the light. Where
    // the block reads L, the kernel of `lit` runs again for each.
    void cone_records(Making& making, size_t light, const LightOutputs& statement, Grid& lit,
                      std::span<float* const> out) const;
    // Records of a statement of the light: where the grid has no part in it, and for its points.
    size_t asked_samples(size_t light, const LightOutputs& statement, bool beside_indirect) const;
    size_t samples_of(size_t light, const LightOutputs& statement, const Grid& grid) const;
    // Of a light that reaches none of the points.
    void dark_records(Making& making, size_t light) const;
    // Up to record `end`.
    void dark_records(Making& making, const LightOutputs& statement, const LightBinding& binding,
                      size_t end) const;
    // What is sent of it is shadowed at once where it is one `sample` of several.
    void make_record(Making& making, const LightOutputs& statement, const LightBinding& binding,
                     std::span<const int> messages, std::span<float* const> out, bool sample,
                     const LightSamples* samples) const;
    // Leaves in the colours what arrives. Of a light on geometry at once: its sample goes with it.
    void shadow(const Making& making) const;

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
    LightBindings bindings_;
    AreaLights area_lights_;
    LightChoice choice_;
    std::vector<LightReach> reaches_;  // of each light, in this frame
    std::vector<float> powers_;        // of one light's triangles
    // Lights in their order.
    struct Lights {
        std::vector<size_t> every;
        std::vector<size_t> present;  // those whose light may reach some surface in this frame
        size_t records = 0;           // of one run
    };
    Lights all_lights_;
    Lights others_;                 // those that no group of choice_ holds
    std::vector<size_t> sampling_;  // those with sample methods
    std::vector<size_t> sending_;   // those whose kernels send rays
    bool all_ = false;
    bool need_rng_ = false;        // some light's kernel does
    bool draws_samples_ = false;   // for some light
    bool sends_indirect_ = false;  // some light's kernel gathers indirect light
    float far_ = 0;                // beyond all that may stand before an endless light
};

}  // namespace kinora
