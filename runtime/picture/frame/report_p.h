// runtime/picture/frame/report_p.h: what a frame tells the user, each thing once.
#pragma once

#include <string>

#include "raytrace/accel.h"
#include "raytrace/tiles/integrator.h"
#include "runtime/picture/frame/frame.h"

namespace kinora {

// False, with a finding, when the camera makes no picture; hints about its range in the first
// frame.
bool report_camera(const Scene& scene, const Pose& pose, raytrace::CameraStatus status,
                   Diagnostics& diagnostics);

// Singular nodes and broken meshes, in the first frame that has them.
void report_geometry(const Scene& scene, Pose& pose, const raytrace::AccelUpdate& update,
                     Diagnostics& diagnostics);

const MeshDefinition& mesh_of(const Scene& scene, const Shape& shape);

// After the imager has run: `bad` of its pixels are not finite.
void report_imager(const Scene& scene, size_t bad, FrameStats& stats, Diagnostics& diagnostics);

// After all tiles: fills `stats` from the counters and reports limits that were met.
void report_shading(const Scene& scene, Pose& pose, const ShadingCounters& shading,
                    const raytrace::IntegratorCounters& counters,
                    const raytrace::IntegratorSettings& settings, FrameStats& stats,
                    Diagnostics& diagnostics);

}  // namespace kinora
