// runtime/scene/ri/calls/outside.cpp: the context of calls that have none.
#include "runtime/scene/ri/calls/outside.h"

#include <memory>

namespace kinora::ri {
namespace {

class KeepingSink : public CallSink {
  public:
    explicit KeepingSink(CallList& kept) : kept_(kept) {}
    void call(const Call& call) override { kept_.add(call); }

  private:
    CallList& kept_;
};

}  // namespace

Outside::Outside() : context(std::make_unique<KeepingSink>(options), diagnostics) {
    diagnostics.judge(Judgement::Rendering);
    context.handler = RiErrorPrint;
    context.for_c_program = true;
}

Outside& outside() {
    thread_local Outside own;
    return own;
}

}  // namespace kinora::ri
