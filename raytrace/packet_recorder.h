// raytrace/packet_recorder.h: a look at all rays that are traced, for measurements.
#pragma once

#include "raytrace/accel.h"

namespace kinora::raytrace {

// Sees each packet before it is traced, on the thread that traces it.
class PacketRecorder {
  public:
    virtual ~PacketRecorder() = default;
    virtual void closest(const RayPacket16& rays) = 0;  // of Accel::intersect16
    virtual void any(const RayPacket16& rays) = 0;      // of Accel::occluded16
};

// Of all Accels, until the next call; null: none. Packets under way may still call the one before.
void record_packets(PacketRecorder* recorder);

}  // namespace kinora::raytrace
