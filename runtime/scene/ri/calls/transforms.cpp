// runtime/scene/ri/calls/transforms.cpp: transformations of ri.h.
#include <span>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;
namespace Code = kinora::Code;

RtVoid RiIdentity() {
    send(Request::Identity, {});
}

RtVoid RiTransform(RtMatrix transform) {
    send(Request::Transform, {matrix(transform)});
}

RtVoid RiConcatTransform(RtMatrix transform) {
    send(Request::ConcatTransform, {matrix(transform)});
}

RtVoid RiPerspective(RtFloat fov) {
    send(Request::Perspective, {fov});
}

RtVoid RiTranslate(RtFloat dx, RtFloat dy, RtFloat dz) {
    send(Request::Translate, {dx, dy, dz});
}

RtVoid RiRotate(RtFloat angle, RtFloat dx, RtFloat dy, RtFloat dz) {
    send(Request::Rotate, {angle, dx, dy, dz});
}

RtVoid RiScale(RtFloat sx, RtFloat sy, RtFloat sz) {
    send(Request::Scale, {sx, sy, sz});
}

RtVoid RiSkew(RtFloat angle, RtFloat dx1, RtFloat dy1, RtFloat dz1, RtFloat dx2, RtFloat dy2,
              RtFloat dz2) {
    send(Request::Skew, {angle, dx1, dy1, dz1, dx2, dy2, dz2});
}

RtVoid RiCoordinateSystem(RtToken space) {
    send(Request::CoordinateSystem, {space});
}

RtVoid RiScopedCoordinateSystem(RtToken space) {
    send(Request::ScopedCoordinateSystem, {space});
}

RtVoid RiCoordSysTransform(RtToken space) {
    send(Request::CoordSysTransform, {space});
}

RtPoint* RiTransformPoints(RtToken fromspace, RtToken tospace, RtInt n, RtPoint points[]) {
    Context* context = Context::current();
    if (!context) {
        tell_not_started();
        return nullptr;
    }
    std::span<float> all(points ? &points[0][0] : nullptr, points && n > 0 ? 3 * size_t(n) : 0);
    const char *from = fromspace ? fromspace : "", *to = tospace ? tospace : "";
    bool known = false;
    context->contained([&] { known = context->sink().transform_points(from, to, all); });
    if (!known) context->error(Code::RI_SPACE, from, to);
    return known ? points : nullptr;
}
