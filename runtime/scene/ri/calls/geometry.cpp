// runtime/scene/ri/calls/geometry.cpp: attributes of geometry of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiBound(RtBound bound) {
    send(Request::Bound, {array(bound, 6)});
}

RtVoid RiDetail(RtBound bound) {
    send(Request::Detail, {array(bound, 6)});
}

RtVoid RiDetailRange(RtFloat minvis, RtFloat lowtran, RtFloat uptran, RtFloat maxvis) {
    send(Request::DetailRange, {minvis, lowtran, uptran, maxvis});
}

RtVoid RiGeometricApproximation(RtToken type, RtFloat value) {
    send(Request::GeometricApproximation, {type, value});
}

RtVoid RiGeometricRepresentation(RtToken type) {
    send(Request::GeometricRepresentation, {type});
}

RtVoid RiOrientation(RtToken orientation) {
    send(Request::Orientation, {orientation});
}

RtVoid RiReverseOrientation() {
    send(Request::ReverseOrientation, {});
}

RtVoid RiSides(RtInt nsides) {
    send(Request::Sides, {nsides});
}

RtVoid RiBasis(RtBasis ubasis, RtInt ustep, RtBasis vbasis, RtInt vstep) {
    send(Request::Basis, {matrix(ubasis), ustep, matrix(vbasis), vstep});
}

RtVoid RiTrimCurve(RtInt nloops, RtInt ncurves[], RtInt order[], RtFloat knot[], RtFloat min[],
                   RtFloat max[], RtInt n[], RtFloat u[], RtFloat v[], RtFloat w[]) {
    int64_t curves = total(array(ncurves, nloops)), points = total(array(n, curves));
    int64_t knots = points + total(array(order, curves));
    send(Request::TrimCurve, {array(ncurves, nloops), array(order, curves), array(knot, knots),
                              array(min, curves), array(max, curves), array(n, curves),
                              array(u, points), array(v, points), array(w, points)});
}
