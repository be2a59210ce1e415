// runtime/scene/ri/calls/camera.cpp: the camera of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiFormat(RtInt xres, RtInt yres, RtFloat aspect) {
    send(Request::Format, {xres, yres, aspect});
}

RtVoid RiFrameAspectRatio(RtFloat aspect) {
    send(Request::FrameAspectRatio, {aspect});
}

RtVoid RiScreenWindow(RtFloat left, RtFloat right, RtFloat bottom, RtFloat top) {
    send(Request::ScreenWindow, {left, right, bottom, top});
}

RtVoid RiCropWindow(RtFloat xmin, RtFloat xmax, RtFloat ymin, RtFloat ymax) {
    send(Request::CropWindow, {xmin, xmax, ymin, ymax});
}

RtVoid RiProjection(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiProjectionV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiProjectionV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Projection, {name}, n, tokens, parms);
}

RtVoid RiClipping(RtFloat hither, RtFloat yon) {
    send(Request::Clipping, {hither, yon});
}

RtVoid RiClippingPlane(RtFloat x, RtFloat y, RtFloat z, RtFloat nx, RtFloat ny, RtFloat nz) {
    send(Request::ClippingPlane, {x, y, z, nx, ny, nz});
}

RtVoid RiDepthOfField(RtFloat fstop, RtFloat focallength, RtFloat focaldistance) {
    send(Request::DepthOfField, {fstop, focallength, focaldistance});
}

RtVoid RiShutter(RtFloat min, RtFloat max) {
    send(Request::Shutter, {min, max});
}
