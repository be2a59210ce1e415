// runtime/scene/ri/calls/blocks.cpp: blocks, objects and motion of ri.h.
#include <vector>

#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiFrameBegin(RtInt number) {
    send(Request::FrameBegin, {number});
}

RtVoid RiFrameEnd() {
    send(Request::FrameEnd, {});
}

RtVoid RiWorldBegin() {
    send(Request::WorldBegin, {});
}

RtVoid RiWorldEnd() {
    send(Request::WorldEnd, {});
}

RtVoid RiAttributeBegin() {
    send(Request::AttributeBegin, {});
}

RtVoid RiAttributeEnd() {
    send(Request::AttributeEnd, {});
}

RtVoid RiTransformBegin() {
    send(Request::TransformBegin, {});
}

RtVoid RiTransformEnd() {
    send(Request::TransformEnd, {});
}

RtVoid RiSolidBegin(RtToken operation) {
    send(Request::SolidBegin, {operation});
}

RtVoid RiSolidEnd() {
    send(Request::SolidEnd, {});
}

RtObjectHandle RiObjectBegin() {
    return send_new(Request::ObjectBegin, {}, 0);
}

RtVoid RiObjectEnd() {
    send(Request::ObjectEnd, {});
}

RtVoid RiObjectInstance(RtObjectHandle handle) {
    send_handle(Request::ObjectInstance, handle);
}

RtVoid RiMotionBeginV(RtInt n, RtFloat times[]) {
    send(Request::MotionBegin, {array(times, n)});
}

RtVoid RiMotionEnd() {
    send(Request::MotionEnd, {});
}

RtVoid RiMotionBegin(RtInt n, ...) {
    std::vector<RtFloat> times;
    va_list list;
    va_start(list, n);
    for (RtInt i = 0; i < n; ++i) times.push_back(RtFloat(va_arg(list, double)));
    va_end(list);
    RiMotionBeginV(n, times.data());
}
