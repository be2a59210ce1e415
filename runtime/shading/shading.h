// runtime/shading/shading.h: the looks of surfaces for the ray tracer: hits to grids to colours.
#pragma once

#include <atomic>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "raytrace/integrator.h"
#include "runtime/shading/grid.h"
#include "runtime/shading/shader_instance.h"

namespace kinora {

struct Scene;

// How often a point may ask for the lights at places of its own, some 8 KB each time: a march may,
// a loop that does not end must not take all memory.
inline constexpr uint32_t kMostLightPlaces = 8192;

struct ShadingCounters {
    raytrace::TraceCounters trace;  // shadow and reflection rays
    uint64_t points = 0;            // surface kernels
    uint64_t light_points = 0;      // light kernels
    uint64_t opacity_points = 0;    // opacity kernels
    uint64_t too_deep = 0;          // rays that met more surfaces than are seen through
    uint64_t unlit = 0;             // questions for lights beyond kMostLightPlaces
    void operator+=(const ShadingCounters& o);
};

// Wavefront shading (docs/decisions.md#lanes-and-wavefronts): hits of a batch are grouped by look,
// shaded in dense grids. One per scene; its memory is kept from frame to frame.
class Shading : public raytrace::SurfaceShading {
  public:
    explicit Shading(Scene& scene);
    ~Shading() override;

    // Before the first shade() of a frame at Scene::time: sizes the threads' memory, runs the frame
    // kernels. Rays see through max_layers surfaces, as those of the camera do.
    void begin_frame(uint32_t seed, int max_layers);
    // The frame ends as soon as it can once this is not 0; null: never.
    void stop_by(const std::atomic<int>* flag) { stop_ = flag; }
    bool stopped() const override { return stop_ && stop_->load(std::memory_order_relaxed) != 0; }
    // After the last: sums counters; reports faults, one finding a source line.
    // `whole`: the picture was finished, so what it baked is written.
    ShadingCounters end_frame(Diagnostics& diagnostics, bool whole = true);

    void shade(const raytrace::HitBatch& hits, int thread, raytrace::ShadeResult& result) override;
    // volumes.cpp: rays that leave the scene end at the camera's far clip where its file has one,
    // else at the far side of the scene: the eye's distance from the centre plus the diagonal.
    float miss_distance() const override;
    void shade_misses(const raytrace::HitBatch& ends, int thread,
                      raytrace::ShadeResult& result) override;
    uint32_t medium_behind(const raytrace::HitBatch& hits, size_t k) const override;
    uint32_t nested_medium(const raytrace::HitBatch& hits, size_t k, vec3 dir) const;

    // imager.cpp: runs the scene's imager over the finished picture, after integrate().
    // The number of its pixels that were not finite; they become what `nan` says.
    size_t run_imager(raytrace::Film& film, raytrace::NanPolicy nan);

    // The services that shoot rays (rsl/model/renderer_services.h), for one lane group of a grid.
    void trace(Grid& grid, const jit::ServiceCall& call);
    void transmission(Grid& grid, const jit::ServiceCall& call);
    void occlusion(Grid& grid, const jit::ServiceCall& call);
    void indirect_diffuse(Grid& grid, const jit::ServiceCall& call);
    int32_t gather_rays(Grid& grid, const jit::ServiceCall& call);
    // A point of bake3d: kept with its pixel, written after the frame.
    void bake(const Grid& grid, const jit::ServiceCall& call);
    uint32_t ray_depth() const;      // the deepest ray that is shot
    uint32_t diffuse_depth() const;  // bounces of indirectdiffuse
    const mat3& camera_from_accel() const { return camera_from_accel_; }
    vec3 eye() const { return eye_; }  // accel space
    // A shader's printf: kept with its pixel, printed in picture order after the frame.
    void print(const Grid& grid, const jit::ServiceCall& call);
    // Light records at other points than the grid's own; their handle.
    int32_t lights_at(Grid& grid, const jit::ServiceCall& call);

    struct Thread;
    struct GatherMemory;
    struct HitOutputs;
    Thread& thread(int index) { return *threads_[size_t(index)]; }

    // Output columns of one illuminate or solar statement (-1: the kernel has none).
    struct Statement {
        rsl::LightKind kind = rsl::kLightAmbient;
        bool casts_shadow = false;
        int L[3], Cl[3], Ol[3], lit = -1;
    };
    // A number of a light that may be animated: in Scene::values, or fixed (`value` is kNone).
    struct LightNumber {
        uint32_t value = kNone;
        float fixed = 0;
    };
    // What one surface look reads of one light.
    struct LightBinding {
        int32_t categories = 0;
        LightNumber nondiffuse, nonspecular;
        std::vector<int> messages;   // output columns
        std::vector<int32_t> known;  // per message: the light has that parameter
    };

  private:
    struct LightPoints;  // where light is wanted
    void shade_look(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                    const ShaderInstance& look, int thread, raytrace::ShadeResult& result);
    void prepare_grid(Grid& grid, int thread);
    void run_kernel(const BoundKernel& bound, Grid& grid, std::span<float* const> out);
    // Takes output rows, runs the kernel and returns them.
    std::span<float*> run_for_colors(const BoundKernel& bound, Grid& grid);
    // volumes.cpp
    struct VolumeOrder;
    uint32_t volume_before(const raytrace::HitBatch& hits, size_t k) const;
    VolumeOrder sort_by_volume(const raytrace::HitBatch& hits, Arena& arena, bool fills_only) const;
    template <class F>
    void for_each_volume_grid(const VolumeOrder& order, F&& f) const;
    void shade_volume(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                      const ShaderInstance& look, const BoundKernel& bound, int thread,
                      bool shadows, raytrace::ShadeResult& result);
    void apply_volumes(const raytrace::HitBatch& hits, int thread, raytrace::ShadeResult& result);
    void pass_volumes(const raytrace::HitBatch& hits, int thread, vec3* Oi);
    size_t image_pixels(raytrace::Film& film, size_t first, size_t count, raytrace::NanPolicy nan);
    // area_light.cpp
    struct AreaLight;
    struct LightSamples;
    void bind_area_lights();
    void update_area_lights();
    void choose_samples(const Grid& grid, const LightPoints& at, const AreaLight& light,
                        uint32_t sample, LightSamples& samples) const;
    jit::Record* area_records(Grid& grid, const LightPoints& at, size_t light, jit::Record* next,
                              const float* zeros);
    void want_lights(Grid& grid) const;
    // light_records.cpp
    void bind_lights();
    void run_lights(Grid& grid);
    jit::Record make_record(Grid& grid, const LightPoints& at, const Statement& statement,
                            const LightBinding& binding, std::span<float* const> out,
                            const float* zeros, const LightSamples* samples = nullptr);
    jit::RecordSet make_records(Grid& grid, const LightPoints& at);
    void shadow(const Grid& grid, const LightPoints& at, bool solar, const float* const L[3],
                const float* lit, float* const Cl[3], const LightSamples* samples);
    // nested_rays.cpp, trace_rays.cpp, gather_rays.cpp
    struct Seen;
    struct GatherJob;
    void see(int thread, raytrace::RayBatch& rays, uint32_t depth, const RayTag& tag,
             std::span<Seen> seen);
    void see_beyond(int thread, const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                    std::span<Seen> seen);
    void pass(int thread, raytrace::RayBatch& rays, std::span<vec3> through);
    void distances(int thread, const raytrace::RayBatch& rays, raytrace::HitStore& store,
                   std::span<float> out);
    void shade_gathered(const GatherJob& job, raytrace::RayBatch& rays);
    using GatherResults = std::span<const rsl::LoweredShader::GatherResult>;
    void copy_colors(GatherResults results, std::span<float* const> columns,
                     const raytrace::ShadeResult& from, size_t count);
    void fill_geometry(GatherResults results, std::span<float* const> columns,
                       const raytrace::HitBatch& hits, int thread);
    void copy_outputs(const HitOutputs& wanted, const jit::Kernel& kernel,
                      std::span<float* const> out, std::span<const uint32_t> points);
    void flush_bakes(bool whole, Diagnostics& diagnostics);  // bake.cpp
    // transmission.cpp
    void pass_transparent(int thread, raytrace::RayBatch& rays, vec3* through);
    void pass_ends(int thread, const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                   vec3* through);
    void opacity(const raytrace::HitBatch& hits, int thread, vec3* Oi);
    void flush_prints();  // print.cpp

    Scene& scene_;
    std::vector<std::unique_ptr<Thread>> threads_;
    std::set<std::string> reported_points_;  // point files that could not be read
    const std::atomic<int>* stop_ = nullptr;
    uint32_t seed_ = 0;
    int max_layers_ = 256;
    bool any_transparent_ = false;
    bool has_exteriors_ = false;
    float miss_distance_ = 0;
    size_t record_count_ = 0;
    std::vector<std::vector<Statement>> statements_;       // [light]
    std::vector<std::vector<LightBinding>> bindings_;      // [look][light]
    std::vector<std::unique_ptr<AreaLight>> area_lights_;  // [light], null where it is none
    bool lights_need_rng_ = false;
    mat3 camera_from_accel_{1.0f};
    vec3 eye_{0.0f};
    friend void gather(Grid&);
};

}  // namespace kinora
