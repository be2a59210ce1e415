// runtime/scene/ri/calls/procedurals.cpp: primitives that are made by a function when they are
// needed.
#include <cstdlib>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

namespace {

struct StandardRow {
    RtProcSubdivFunc function;
    const char* name;
    int strings;
};
constexpr StandardRow kStandard[] = {
    {RiProcDelayedReadArchive, "DelayedReadArchive", 1},
    {RiProcRunProgram, "RunProgram", 2},
    {RiProcDynamicLoad, "DynamicLoad", 2},
};

void send_standard(const StandardRow& row, RtPointer data, std::span<const float> bound) {
    auto* strings = static_cast<char**>(data);
    send(Request::Procedural, {row.name, array(strings, row.strings), bound});
}

constexpr float kEverywhere[] = {-RI_INFINITY, RI_INFINITY,  -RI_INFINITY,
                                 RI_INFINITY,  -RI_INFINITY, RI_INFINITY};

}  // namespace

RtVoid RiProcDelayedReadArchive(RtPointer data, RtFloat) {
    send_standard(kStandard[0], data, kEverywhere);
}

RtVoid RiProcRunProgram(RtPointer data, RtFloat) {
    send_standard(kStandard[1], data, kEverywhere);
}

RtVoid RiProcDynamicLoad(RtPointer data, RtFloat) {
    send_standard(kStandard[2], data, kEverywhere);
}

RtVoid RiProcFree(RtPointer data) {
    std::free(data);
}

// A ray tracer needs all of a scene, so a program's own function is called at once, as if its
// primitive filled the picture.
RtVoid RiProcedural(RtPointer data, RtBound bound, RtProcSubdivFunc subdivide,
                    RtProcFreeFunc free) {
    if (!Context::current()) return tell_not_started();
    bool standard = false;
    for (const StandardRow& row : kStandard)
        if (row.function == subdivide && (standard = true))
            send_standard(row, data, bound ? array(bound, 6) : std::span(kEverywhere));
    if (!standard && subdivide) {
        RiAttributeBegin();
        subdivide(data, RI_INFINITY);
        RiAttributeEnd();
    }
    if (free) free(data);
}
