// runtime/picture/shading/ray_queue.h: the queue of the rays that shaders send: planned, made,
// noted or traced, shaded and summed by the same stages, whatever their kind
// (ARCHITECTURE.md#a-ray).
#pragma once

#include <optional>
#include <span>

#include "runtime/base/parallel.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/lane_rays.h"
#include "runtime/picture/shading/rays/plan.h"

namespace kinora {

class HitShader;
class RayQueue;
class Transmission;

// Gives rays of a batch, from `first` on, what their kind decides. Their time is that of the hit
// they leave; the kind itself is the same for a batch: RayTag.
void set_kind(raytrace::RayBatch& rays, size_t first, RayKind kind);

// What a point has for its next call, as far as the grid says.
PointBudget budget_of(Grid& grid, size_t point);

// What a call wants to send from one lane.
struct RayWish {
    int samples = 0;      // none: nothing is counted
    bool aims = true;     // they have a direction
    bool shoots = true;   // else they need no ray
    bool unshot = false;  // they count even where no ray may be sent
    bool turns = false;   // each is a turn of a loop, so a call that may not shoot is refused
    // What a traced ray counts at its point and what goes on behind it; below 0: not known.
    float weight = -1, through = -1;
};

// What a ray saw.
struct SeenByRay {
    vec3 color{0.0f};
    vec3 open{1.0f};         // share of what lies behind that is let through
    float distance = kMiss;  // of the nearest surface
};

// A call that sends rays.
struct RayCall {
    RayKind kind;
    Grid& grid;
    const Lanes& lanes;
    const RayPlan& plan;
    int rows = 0;            // of its arguments, which tell calls apart
    int label = -1;          // the row of the rays' label; below 0: they have none
    bool distances = false;  // rays that find what passes find the nearest surface, too
    bool diffuse = false;    // they find light that a point gets from all around
    uint32_t scattered = 0;  // lanes whose rays go in many directions, of which each shows little
    bool counted = false;    // the point has the specular light of its lights by their samples
};

// Adds the rays of samples, whose slots count up from `slot`; none for those that see nothing.
using AddSamples =
    FunctionRef<void(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot)>;
// Takes what the samples saw. Samples of a lane come in their order, so that no sum depends on
// neighbours.
using SumSamples = FunctionRef<void(const SampleSpan& samples, std::span<const SeenByRay> seen)>;
// Takes what the rays of samples met; a slot is the number of the sample.
using MeetSamples = FunctionRef<void(const SampleSpan& samples, const raytrace::RayBatch& rays,
                                     const raytrace::HitBatch& hits, const RayTag& tag)>;

class RayQueue {
  public:
    RayQueue(const ShadingFrame& frame, HitShader& hits, Transmission& transmission)
        : frame_(frame), hits_(hits), transmission_(transmission) {}

    // How many rays of the kind each lane may send.
    RayPlan plan(RayKind kind, Grid& grid, const Lanes& lanes,
                 FunctionRef<RayWish(int lane)> wish_of) const;
    // Sends the rays of a call, unless its plan is empty. Rays of calls that are noted are summed
    // when their kernel runs again.
    void send(const RayCall& call, const AddSamples& add, const SumSamples& sum);
    // The same for rays that find hits.
    void send(const RayCall& call, const AddSamples& add, const MeetSamples& meet);

    // Stages, for rays that are made already: what they find, by slot; `seen` has a place for each
    // slot. They consume the rays.
    void see(raytrace::RayBatch& rays, uint32_t depth, const RayTag& tag, ThreadMemory& memory,
             std::span<SeenByRay> seen);
    void pass(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory, bool distances,
              std::span<SeenByRay> seen);

  private:
    static bool is_noting(const Grid& grid);
    // --clamp-indirect.
    void dim(const RayTag& tag, std::span<SeenByRay> seen) const;
    void send_alike(const RayCall& call, const RayTag& tag, const AddSamples& add,
                    const SumSamples& sum);
    void see_layer(raytrace::RayBatch& rays, const raytrace::HitBatch& hits, const RayTag& tag,
                   ThreadMemory& memory, std::span<SeenByRay> seen);
    void see_beyond(const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                    const RayTag& tag, ThreadMemory& memory, std::span<SeenByRay> seen);
    void find_distances(const raytrace::RayBatch& rays, ThreadMemory& memory,
                        std::span<SeenByRay> seen) const;

    const ShadingFrame& frame_;
    HitShader& hits_;
    Transmission& transmission_;
};

// Rays of many points in full batches (docs/rays.md#full-packets). A kernel that shoots rays runs
// twice: first its calls only say which rays they send, and see nothing; these rays are traced
// together; then the calls get what was seen. A call whose arguments depend on what an earlier one
// saw asks for other rays the second time, which are traced for it alone.
class RayNotes {
  public:
    // Of grids whose hits rays of `depth` see.
    RayNotes(RayQueue& queue, uint32_t depth, ThreadMemory& memory)
        : queue_(queue), depth_(depth), memory_(memory) {}

    // Between these two, calls are noted.
    void start();
    void finish();
    // Before the second run of a grid, of a surface or of a light at a surface's points.
    void answer(const Grid& grid);
    // Forgets all calls, whose memory is the arena's.
    void reset();

  private:
    friend class RayQueue;
    struct Note;
    static bool is_of(const Note* note, const Grid& grid);
    bool open() const { return open_; }
    // Notes a call, whose rays wait for those of others.
    void note(const RayCall& call, const RayTag& tag, const AddSamples& add);
    Note& add_note(const RayCall& call);
    // What the rays of the same call saw; nothing where it was not noted.
    std::optional<std::span<const SeenByRay>> find(const RayCall& call);
    // Rays of one tag that wait.
    struct Batch {
        Batch(const RayTag& of, ThreadMemory& memory);
        RayTag tag;
        NestedWavefront wave;
        std::span<SeenByRay*> targets;  // of each ray
    };
    Batch& batch_of(const RayTag& tag);
    void flush(Batch& batch);

    // Calls of a kernel take turns: rays of so many tags wait beside each other.
    static constexpr size_t kMostTags = 6;

    RayQueue& queue_;
    uint32_t depth_;
    ThreadMemory& memory_;
    std::optional<Batch> batches_[kMostTags];  // the first ones
    Note *first_ = nullptr, *last_ = nullptr;
    Note* next_ = nullptr;  // of the grid that is answered
    bool open_ = false;
};

// Whether depth forbids rays of the kind to leave the grid's points, which the kernel of the look
// would send: the surface's own, or that of a light that lights it.
bool is_too_deep(const RayKindRow& row, const Grid& grid, const ShaderInstance& look);
// Whether the kernel of a look calls services whose rays may be sent from the grid's points and
// wait for others.
bool sends_noted_rays(const ShaderInstance& look, const Grid& grid);

}  // namespace kinora
