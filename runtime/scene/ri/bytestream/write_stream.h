// runtime/scene/ri/bytestream/write_stream.h: calls to RIB.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {

enum class StreamForm : uint8_t { Ascii, Binary };

// The words of a stream in one form.
class StreamWords;

// Writes each call as a request, so that reading it gives the same call: numbers with all their
// digits, undeclared tokens with inline declarations. Blocks indent ASCII.
class StreamWriter : public CallSink {
  public:
    using Write = std::function<void(std::string_view bytes)>;
    StreamWriter(StreamForm form, Write write);
    ~StreamWriter() override;
    void call(const Call& call) override;

  private:
    void add_argument(char letter, const Values& values);
    void add_arguments(const Call& call);
    void note_declaration(const Call& call);
    std::string token(const Parameter& parameter) const;

    std::unique_ptr<StreamWords> words_;
    Write write_;
    int depth_ = 0;
    Declarations declared_;
    std::set<std::string, std::less<>> scoped_;  // declared for some shaders alone, too
};

}  // namespace kinora::ri
