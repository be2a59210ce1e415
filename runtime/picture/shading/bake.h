// runtime/picture/shading/bake.h: point files as bake3d writes them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "rsl/model/renderer_services.h"
#include "runtime/base/diagnostic.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/scene/images/point_file.h"

namespace kinora {

// A point of bake3d: P, N, radius, then its channels' numbers.
struct BakedPoint {
    int32_t file = 0, channels = 0;  // interned
    uint32_t pixel_y = 0, pixel_x = 0, layer = 0, order = 0;
    float numbers[kPointHead + rsl::kPointFloats];
};

class Bakes {
  public:
    Bakes(const SceneResources& resources, const Pose& pose) : resources_(resources), pose_(pose) {}
    void begin_frame(size_t threads);
    // A call at a grid's points: kept with their pixels.
    void add(const Grid& grid, const jit::ServiceCall& call);
    // Writes the files in picture order, if the picture is `whole`, and forgets all points. Reports
    // what could not be written or read, each file that could not be read once.
    void flush(bool whole, Diagnostics& diagnostics);

  private:
    const SceneResources& resources_;
    const Pose& pose_;
    std::vector<std::vector<BakedPoint>> points_;  // by thread
    std::set<std::string> reported_;               // files that could not be read
};

}  // namespace kinora
