// runtime/scene/ri/bytestream/write_stream.h: calls to RIB.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {

enum class StreamForm : uint8_t { Ascii, Binary };

// Writes each call as a request, so that reading it gives the same call: numbers with all their
// digits, undeclared tokens with inline declarations. Blocks indent ASCII.
class StreamWriter : public CallSink {
  public:
    using Write = std::function<void(std::string_view bytes)>;
    StreamWriter(StreamForm form, Write write);
    void call(const Call& call) override;

  private:
    StreamForm form_;
    Write write_;
    int depth_ = 0;
};

}  // namespace kinora::ri
