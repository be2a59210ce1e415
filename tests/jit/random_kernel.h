// tests/jit/random_kernel.h: the frame of generators that write one random kernel.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include "jit/ir/builder.h"
#include "tests/jit/world.h"

namespace kinora::jit::test {

// A module with the inputs and services of a World and an open kernel. A generator derives from it,
// writes the body and finishes the builder in its constructor.
class RandomKernel {
  public:
    Module module;

  protected:
    RandomKernel(uint64_t seed, const char* name) : random_(seed) {
        declare_world(module);
        module.name = name;
        add_function(module, "kernel", {});
        builder_.emplace(module, 0);
    }
    Builder& b() { return *builder_; }
    int below(int n) { return int(random_() % uint64_t(n)); }
    Value any(const std::vector<Value>& values) {
        return values[size_t(below(int(values.size())))];
    }
    Value sum(const std::vector<Value>& values) {
        Value s = b().f(0);
        for (Value v : values) s = b().add(s, v);
        return s;
    }

  private:
    std::mt19937_64 random_;
    std::optional<Builder> builder_;
};

}  // namespace kinora::jit::test
