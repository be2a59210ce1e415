// runtime/scene/ri/calls/errors.cpp: the error handlers of ri.h.
#include <cstdio>
#include <cstdlib>

#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

namespace {

const char* handler_name(RtErrorHandler handler) {
    if (handler == RiErrorPrint) return "print";
    if (handler == RiErrorAbort) return "abort";
    return handler == RiErrorIgnore || !handler ? "ignore" : nullptr;
}

}  // namespace

RtVoid RiErrorIgnore(RtInt, RtInt, char*) {}

RtVoid RiErrorPrint(RtInt code, RtInt severity, char* message) {
    constexpr const char* kSeverities[] = {"info", "warning", "error", "severe error"};
    std::fprintf(stderr, "RenderMan Interface: %s %d: %s\n", kSeverities[severity & 3], code,
                 message);
}

RtVoid RiErrorAbort(RtInt code, RtInt severity, char* message) {
    RiErrorPrint(code, severity, message);
    if (severity >= RIE_ERROR) std::exit(1);
}

// A program's own function has no name for RIB.
RtVoid RiErrorHandler(RtErrorHandler handler) {
    current_or_outside().handler = handler;
    const char* name = handler_name(handler);
    if (name && Context::current()) send(Request::ErrorHandler, {name});
}
