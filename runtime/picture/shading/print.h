// runtime/picture/shading/print.h: printf of shaders at the points of pictures: formatted at once,
// shown in picture order after the frame.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/picture/shading/grid.h"

namespace kinora {

// What the shaders of a scene print at the points of pictures.
class Prints {
  public:
    void begin_frame(size_t threads);
    // A call at a grid's points: kept with their pixels.
    void add(const Grid& grid, const jit::ServiceCall& call);
    // Shows and forgets all; of each shader the first in the order of the picture.
    void flush(const SceneShaders& scene, const PrintTo& show, Diagnostics& diagnostics);
    // Forgets all.
    void drop();

  private:
    struct Print {
        uint32_t pixel_y, pixel_x, sample;
        uint64_t order;  // of the calls of one thread, which has whole pixels
        uint32_t look;
        std::string text;
        bool operator<(const Print& o) const;
    };
    struct OfLook {
        std::vector<Print> prints;
        size_t bytes = 0;
        uint64_t asked = 0;
        // Pixel and sample that trim() has cut in: nothing behind is shown.
        std::tuple<uint32_t, uint32_t, uint32_t> end{~0u, ~0u, ~0u};
    };
    struct OfThread {
        std::vector<OfLook> looks;
        uint64_t calls = 0;
    };
    static void trim(OfLook& of);

    std::vector<OfThread> threads_;
};

}  // namespace kinora
