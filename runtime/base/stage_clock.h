// runtime/base/stage_clock.h: where a frame's time goes: stages that exclude each other, one clock
// a thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace kinora {

// The stages of a frame. A scope inside another takes its time away from it, so that the stages of
// a clock add up to its life.
enum class Stage : uint8_t {
    Other,  // what no scope names
    Animate,
    Skin,  // transformations and displacements too
    Refit,
    Sample,   // samples and camera rays
    Trace,    // closest hits
    Points,   // surface points and footprints of hits
    Gather,   // columns of grids, results back to hits
    Lights,   // light records, without their kernels
    Shadows,  // the rays of lights, made and traced
    Kernels,  // kernels and their services without rays
    Nested,   // rays that shaders shoot, made and answered
    Film,     // layers, samples to pixels, tiles to the picture
    Imager,
    Idle,  // threads without a tile
    Count
};
inline constexpr size_t kStageCount = size_t(Stage::Count);
const char* stage_name(Stage stage);  // "sample"

struct StageTicks {
    std::array<uint64_t, kStageCount> of{};
    uint64_t& operator[](Stage s) { return of[size_t(s)]; }
    uint64_t operator[](Stage s) const { return of[size_t(s)]; }
    uint64_t sum() const;
    void operator+=(const StageTicks& o);
};

// The CPU's counter: cheap, of any rate.
uint64_t cpu_ticks();

class StageClock {
  public:
    using Now = uint64_t (*)();
    explicit StageClock(Now now = cpu_ticks) : now_(now), since_(now()) {}
    // Ends the stage under way; returns it.
    Stage enter(Stage stage);
    // All that has passed since the clock was made, up to now.
    StageTicks ticks();

  private:
    Now now_;
    uint64_t since_;
    Stage stage_ = Stage::Other;
    StageTicks ticks_;
};

// The clock of this thread while the object lives; the one before returns after it.
class RunningClock {
  public:
    explicit RunningClock(StageClock& clock);
    ~RunningClock();
    RunningClock(const RunningClock&) = delete;

  private:
    StageClock* before_;
};

// A stage for its scope, on this thread's clock if one runs: two readings of the counter. For
// batches, never for single points.
class StageScope {
  public:
    explicit StageScope(Stage stage);
    ~StageScope();
    StageScope(const StageScope&) = delete;

  private:
    StageClock* clock_;
    Stage before_ = Stage::Other;
};

// Milliseconds of a frame by stage. `frame`: the clock of the thread that runs it; its Idle, when
// it shared tiles out, gives way to the mean over the threads of what `tiles` sums over them.
// The result adds up to total_ms.
std::array<double, kStageCount> stage_ms(const StageTicks& frame, const StageTicks& tiles,
                                         int threads, double total_ms);

}  // namespace kinora
