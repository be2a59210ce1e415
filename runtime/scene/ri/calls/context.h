// runtime/scene/ri/calls/context.h: what the C functions of ri.h work on: declarations, handles,
// the error handler, and the sink that takes the calls.
#pragma once

#include <fmt/core.h>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/calls/ri.h"

namespace kinora::ri {

// How a finding is told to an error handler.
struct ErrorCode {
    int code;      // RIE_BADTOKEN
    int severity;  // RIE_ERROR
};
ErrorCode error_code(const FindingInfo& finding);

// The numbers of values that a call's variables have (RIB.md, section 7). Nothing: the arguments
// contradict each other; `why` says how.
struct CountedCall {
    Counts counts;
    std::string why;  // "": all is well
};
CountedCall count_values(Request request, std::span<const Values> arguments,
                         const CountState& state, uint32_t vertices);

// The filter of ri.h that RIB calls "gaussian", ...; null: there is none of that name.
RtFilterFunc filter_function(std::string_view name);
std::string filter_names();  // "box, triangle, ..."

// One begun by RiBegin, or by a reader of files. Used by one thread at a time.
class Context {
  public:
    Context(std::unique_ptr<CallSink> sink, Diagnostics& diagnostics);
    ~Context();
    Context(const Context&) = delete;

    // The one of this thread; null: none was begun, or it has ended, on whichever thread.
    static Context* current();
    static void make_current(Context* context);

    // Reports a finding at `where`, and tells the error handler.
    template <class... Args>
    void error(const FindingInfo& info, const Args&... args) {
        diagnostics_.report(info, where, args...);
        tell();
    }
    // Tells the error handler what was found since it was told last, by the sink too. The end of
    // each send() does.
    void tell();
    // Does a part of a call. For a C program, which no exception may reach, what it throws becomes
    // an error.
    template <class Body>
    void contained(const Body& body) {
        if (!for_c_program) return body();
        Busy busy(*this);
        try {
            body();
        } catch (...) {
            report_exception();
        }
        tell();
    }

    // What a token means: an inline declaration ("uniform float Kd"), a declared name, or what the
    // shader says. `name` is the token without a declaration. Null: not known.
    std::optional<Declaration> resolve(Request request, std::string_view shader,
                                       std::string_view token, std::string_view& name);

    // A call of it is being done, which called the program's own code.
    bool is_busy() const { return busy_ > 0; }

    // Sends a call on; counts, and attribute blocks for them, are kept here. `vertices`: of
    // requests that have their number of points from the caller alone.
    void send(Request request, std::span<const Values> arguments, int n, RtToken tokens[],
              RtPointer values[], uint32_t vertices = 0);

    // Lights, objects and archives: a handle's number, from 1; 0: it is none of ours.
    RtPointer new_handle();
    int handle_number(RtPointer handle) const;

    const CountState& count_state() const { return counts_.back(); }
    Declarations& declarations() { return declarations_; }
    CallSink& sink() { return *sink_; }
    Diagnostics& diagnostics() { return diagnostics_; }

    Location where;                                // of the request that is being read
    RtErrorHandler handler = nullptr;              // null: findings are kept, no more
    RtArchiveCallback archive_callback = nullptr;  // hears comments of the archive being read
    bool for_c_program = false;                    // findings are dropped when they were told, too

    // The end of a C program's context: how many findings were not printed.
    void tell_unprinted();

  private:
    struct Busy {
        explicit Busy(Context& own) : context(own) { ++context.busy_; }
        ~Busy() { --context.busy_; }
        Context& context;
    };
    void tell(const Finding& finding);
    void report_exception();
    void send_contained(Request request, std::span<const Values> arguments, int n, RtToken tokens[],
                        RtPointer values[], uint32_t vertices);
    void follow_blocks(Request request, std::span<const Values> arguments);
    void follow_calls_of_sink(Request request);

    // Threads that have it for their current one keep this, so that none uses it after its end.
    struct Life {
        std::atomic<Context*> context;
    };
    static std::shared_ptr<Life>& current_life();

    // RiErrorPrint prints so many findings of each code.
    static constexpr int kMostPrinted = 200;
    bool is_printed(const Finding& finding);

    std::shared_ptr<Life> life_;
    std::unique_ptr<CallSink> sink_;
    Diagnostics& diagnostics_;
    std::map<const FindingInfo*, int> printed_;
    int unprinted_ = 0;
    size_t told_ = 0;  // of the findings
    bool telling_ = false;
    int busy_ = 0;
    Declarations declarations_;
    int handles_ = 0;
    std::vector<CountState> counts_;
    std::vector<Parameter> spare_parameters_;  // memory for the next call's
};

}  // namespace kinora::ri
