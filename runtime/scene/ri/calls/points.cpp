// runtime/scene/ri/calls/points.cpp: points, curves, blobs and the like of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiPoints(RtInt npoints, ...) {
    KINORA_PAIRS(npoints);
    RiPointsV(npoints, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiPointsV(RtInt npoints, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Points, {}, n, tokens, parms, npoints);
}

RtVoid RiCurves(RtToken type, RtInt ncurves, RtInt nvertices[], RtToken wrap, ...) {
    KINORA_PAIRS(wrap);
    RiCurvesV(type, ncurves, nvertices, wrap, pairs.count(), pairs.tokens.data(),
              pairs.values.data());
}

RtVoid RiCurvesV(RtToken type, RtInt ncurves, RtInt nvertices[], RtToken wrap, RtInt n,
                 RtToken tokens[], RtPointer parms[]) {
    send(Request::Curves, {type, array(nvertices, ncurves), wrap}, n, tokens, parms);
}

RtVoid RiBlobby(RtInt nleaf, RtInt ncode, RtInt code[], RtInt nfloats, RtFloat floats[],
                RtInt nstrings, RtString strings[], ...) {
    KINORA_PAIRS(strings);
    RiBlobbyV(nleaf, ncode, code, nfloats, floats, nstrings, strings, pairs.count(),
              pairs.tokens.data(), pairs.values.data());
}

RtVoid RiBlobbyV(RtInt nleaf, RtInt ncode, RtInt code[], RtInt nfloats, RtFloat floats[],
                 RtInt nstrings, RtString strings[], RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Blobby,
         {nleaf, array(code, ncode), array(floats, nfloats), array(strings, nstrings)}, n, tokens,
         parms);
}

RtVoid RiGeometry(RtToken type, ...) {
    KINORA_PAIRS(type);
    RiGeometryV(type, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiGeometryV(RtToken type, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Geometry, {type}, n, tokens, parms);
}
