// tests/bench/recorded_frame.h: a frame's rays and the launches of its kernels, recorded and played
// back (frame_floor.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/packet_recorder.h"
#include "runtime/scene/kernels/kernel_probe.h"

namespace kinora {

enum class RayUse : uint8_t { Camera, Nested, Shadow };

struct RecordedRay {
    float org[3], dir[3], tnear, tfar, window;
    uint32_t mask, passed_first, passed_last;
};

// All packets of a frame, without the lanes that are not in use.
class RecordedRays : public raytrace::PacketRecorder {
  public:
    void closest(const raytrace::RayPacket16& packet) override;
    void any(const raytrace::RayPacket16& packet) override;

    // Packets ready to be traced, of one use: as they came, and the same rays in full packets,
    // sorted by the cell of the origin (of 32 in each axis of all origins' box), then by the
    // direction's place on an octahedron.
    std::vector<raytrace::RayPacket16> as_sent(RayUse use) const;
    std::vector<raytrace::RayPacket16> sorted(RayUse use) const;

  private:
    struct Packet {
        uint32_t active;
        RayUse use;
        bool passing;
    };
    void add(const raytrace::RayPacket16& packet, RayUse use);

    std::vector<Packet> packets_;
    std::vector<RecordedRay> rays_;  // of the packets, one behind the other
};

// Runs each launch, keeping what services answer, and then `runs` times with the same answers.
// Launches whose services hand out memory that is let go again run once and are left out.
class ReplayedKernels : public KernelProbe {
  public:
    explicit ReplayedKernels(int runs) : runs_(runs) {}
    void run(const jit::KernelCall& call) override;

    uint64_t ticks = 0;  // the least of each launch's runs, summed
    uint64_t points = 0, launches = 0, left_out = 0;

  private:
    int runs_;
};

}  // namespace kinora
