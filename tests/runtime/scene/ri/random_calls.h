// tests/runtime/scene/ri/random_calls.h: calls of all requests with arguments of all forms.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {

struct RandomCallMaker;

// Sound calls in no order that makes sense: each has the arguments that its row asks for, as many
// values as its counts, and parameters of any declaration.
class RandomCalls {
  public:
    explicit RandomCalls(uint32_t seed);
    ~RandomCalls();

    // Makes one with the C functions, or as they do.
    void call(Context& context);

  private:
    std::unique_ptr<RandomCallMaker> maker_;
};

}  // namespace kinora::ri
