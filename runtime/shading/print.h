// runtime/shading/print.h: printf of shaders: formatted at once, shown in picture order after the
// frame.
#pragma once

#include <string>
#include <vector>

#include "runtime/shading/grid.h"

namespace kinora {

// The format (argument 0, an interned string) with the values of one lane. RSL's letters: %f %d
// floats, %c %p %v %n triples, %m a matrix, %s a string (RISpec 3.2, printf).
std::string print_text(const jit::ServiceCall& call, int lane);

class Prints {
  public:
    void begin_frame(size_t threads);
    // A call at a grid's points: kept with their pixels.
    void add(const Grid& grid, const jit::ServiceCall& call);
    // Shows and forgets all.
    void flush();
    // Forgets all.
    void drop();

  private:
    struct Print {
        uint32_t pixel_y, pixel_x, sample, order;
        std::string text;
    };
    std::vector<std::vector<Print>> prints_;  // by thread
};

}  // namespace kinora
