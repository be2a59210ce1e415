// runtime/ri/begin.cpp: contexts of C programs: RiBegin, RiEnd, RiGetContext, RiContext.
#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/ri/session.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/functions_p.h"
#include "runtime/scene/ri/calls/outside.h"

namespace kinora::ri {
namespace {

// The sessions of all threads; a program may begin one on a thread and end it on another. What is
// not ended when the program ends is left as it is.
class Sessions {
  public:
    Context& add(std::unique_ptr<Session> session) {
        std::lock_guard lock(mutex_);
        sessions_.push_back(std::move(session));
        return sessions_.back()->context();
    }
    bool has(const void* context) {
        std::lock_guard lock(mutex_);
        return find(context) != sessions_.end();
    }
    std::unique_ptr<Session> take(const void* context) {
        std::lock_guard lock(mutex_);
        auto found = find(context);
        if (found == sessions_.end()) return nullptr;
        std::unique_ptr<Session> session = std::move(*found);
        sessions_.erase(found);
        return session;
    }

  private:
    std::vector<std::unique_ptr<Session>>::iterator find(const void* context) {
        return std::ranges::find(sessions_, context, [](const auto& session) {
            return static_cast<const void*>(&session->context());
        });
    }

    std::mutex mutex_;
    std::vector<std::unique_ptr<Session>> sessions_;
};

Sessions& sessions() {
    static Sessions& all = *new Sessions;
    return all;
}

void begin(const char* name) {
    const bool renders = !name || !*name;
    Context& context = sessions().add(renders ? render_session() : rib_session(name));
    context.for_c_program = true;
    context.handler = outside().context.handler;
    Context::make_current(&context);
    context.contained([&] {
        for (const Call& option : outside().options.calls()) context.sink().call(option);
    });
}

// A callback cannot end the context that called it.
void end() {
    Context* current = Context::current();
    if (current && current->is_busy())
        return current->error(Code::RI_NESTING, "End", "a call of this context is being done");
    std::unique_ptr<Session> session = sessions().take(current);
    if (!session) return tell_not_started();
    session->context().contained([&] { session->finish(); });
    session->context().tell_unprinted();
}

}  // namespace
}  // namespace kinora::ri

using namespace kinora::ri;

RtVoid RiBegin(RtToken name) {
    outside().context.contained([&] { begin(name); });
}

RtVoid RiEnd() {
    outside().context.contained([&] { end(); });
}

RtContextHandle RiGetContext() {
    return Context::current();
}

// RI_NULL: none, as after RiEnd.
RtVoid RiContext(RtContextHandle handle) {
    if (handle && !sessions().has(handle))
        return current_or_outside().error(kinora::Code::RI_HANDLE, "Context");
    Context::make_current(static_cast<Context*>(handle));
}
