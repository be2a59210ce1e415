// runtime/shading/print.h: printf of shaders: formatted at once, shown in picture order after the
// frame.
#pragma once

#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/shading/grid.h"

namespace kinora {

// What one shader may print in a frame.
inline constexpr uint64_t kMostPrints = 10000;
inline constexpr size_t kMostPrintBytes = 1 << 20;

// The format (argument 0, an interned string) with the values of one lane. RSL's letters: %f %d
// floats, %c %p %v %n triples, %m a matrix, %s a string (RISpec 3.2, printf).
std::string print_text(const jit::ServiceCall& call, int lane);

// What a shader prints in an order that is known: the first of it.
class PrintedLines {
  public:
    void add(std::string text);
    void add(const jit::ServiceCall& call, int lane);
    // Behind these, others.
    void add(PrintedLines&& others);
    void show(std::FILE* to = stdout) const;
    void clear() { *this = {}; }
    uint64_t asked() const { return asked_; }
    size_t shown() const { return lines_.size(); }
    // Reports what was left out.
    void report(const std::string& shader, Diagnostics& diagnostics) const;

  private:
    bool full() const { return left_out_ || lines_.size() == kMostPrints; }

    std::vector<std::string> lines_;
    size_t bytes_ = 0;
    uint64_t asked_ = 0;
    bool left_out_ = false;  // for its length
};

// What the shaders of a scene print at the points of pictures.
class Prints {
  public:
    void begin_frame(size_t threads);
    // A call at a grid's points: kept with their pixels.
    void add(const Grid& grid, const jit::ServiceCall& call);
    // Shows and forgets all; of each shader the first in the order of the picture.
    void flush(const Scene& scene, Diagnostics& diagnostics);
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
