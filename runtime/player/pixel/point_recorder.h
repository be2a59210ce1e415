// runtime/player/pixel/point_recorder.h: kernels watched while one sample of a pixel is shaded.
#pragma once

#include <functional>

#include "runtime/picture/shading/grid_host.h"
#include "runtime/player/pixel/recorded_calls.h"

namespace kinora {

// A surface kernel that ran at a point which the camera sees. All of it is valid only while
// `found` runs.
struct RecordedPoint {
    const GridHost& host;
    const jit::KernelCall& launch;  // done: its outputs are there
    RecordedCalls& calls;
    // Lights at other positions than P, which illuminance() was given.
    struct LightsAt {
        std::array<double, 3> position;
        std::vector<rsl::ReferenceLight> lights;
    };
    std::vector<LightsAt> lights_at;
    // What lights with sample methods sent from the directions of each call of samplinglights.
    std::vector<std::vector<rsl::ReferenceLight>> sampled = {};
};

// Sees the launches of the thread that makes it. At the camera's points (grids of one point) it
// notes what services answer. One at a time a thread.
class PointRecorder {
  public:
    explicit PointRecorder(std::function<void(RecordedPoint&)> found);
    ~PointRecorder();
    PointRecorder(const PointRecorder&) = delete;

    void run(const jit::KernelCall& call);
    // Called by a service's stand-in, after the service.
    void note(rsl::Service service, const jit::ServiceCall& call);

  private:
    std::function<void(RecordedPoint&)> found_;
    const GridHost* host_ = nullptr;  // of the point that is being recorded
    RecordedPoint* point_ = nullptr;
};

// Lets recorders see launches from now on. Before the first kernel runs.
void watch_launches();

}  // namespace kinora
