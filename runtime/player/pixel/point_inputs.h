// runtime/player/pixel/point_inputs.h: what the reference evaluator needs of a shading point.
#pragma once

#include <string>
#include <vector>

#include "rsl/reference/reference.h"
#include "runtime/picture/shading/grid_host.h"

namespace kinora {

struct SceneDescription;

// All globals, parameters and spaces at the only point of the host's grid, whether its kernel reads
// them or not: numbers as kernels have them.
rsl::ReferenceInputs point_inputs(const GridHost& host, const std::vector<rsl::Layer>& layers);

// The lights of a record set at that point; their numbers are those of the records.
std::vector<rsl::ReferenceLight> point_lights(const GridHost& host, const jit::RecordSet& set);

// The name of each record's light.
std::vector<std::string> record_names(const GridHost& host);

// Coordinate systems that the scene adds to the standard ones.
std::vector<std::string> space_names(const SceneDescription& description);

}  // namespace kinora
