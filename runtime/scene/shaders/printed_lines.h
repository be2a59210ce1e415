// runtime/scene/shaders/printed_lines.h: printf of shaders: what one shader prints in an order that
// is known.
#pragma once

#include <string>
#include <vector>

#include "jit/ir/kernel_call.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/scene_options.h"

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
    void show(const PrintTo& to) const;
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

}  // namespace kinora
