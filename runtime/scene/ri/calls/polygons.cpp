// runtime/scene/ri/calls/polygons.cpp: polygons and subdivision meshes of ri.h.
#include <algorithm>

#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiPolygon(RtInt nvertices, ...) {
    KINORA_PAIRS(nvertices);
    RiPolygonV(nvertices, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiPolygonV(RtInt nvertices, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Polygon, {}, n, tokens, parms, nvertices);
}

RtVoid RiGeneralPolygon(RtInt nloops, RtInt nverts[], ...) {
    KINORA_PAIRS(nverts);
    RiGeneralPolygonV(nloops, nverts, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiGeneralPolygonV(RtInt nloops, RtInt nverts[], RtInt n, RtToken tokens[],
                         RtPointer parms[]) {
    send(Request::GeneralPolygon, {array(nverts, nloops)}, n, tokens, parms);
}

RtVoid RiPointsPolygons(RtInt npolys, RtInt nverts[], RtInt verts[], ...) {
    KINORA_PAIRS(verts);
    RiPointsPolygonsV(npolys, nverts, verts, pairs.count(), pairs.tokens.data(),
                      pairs.values.data());
}

RtVoid RiPointsPolygonsV(RtInt npolys, RtInt nverts[], RtInt verts[], RtInt n, RtToken tokens[],
                         RtPointer parms[]) {
    auto faces = array(nverts, npolys);
    send(Request::PointsPolygons, {faces, array(verts, total(faces))}, n, tokens, parms);
}

RtVoid RiPointsGeneralPolygons(RtInt npolys, RtInt nloops[], RtInt nverts[], RtInt verts[], ...) {
    KINORA_PAIRS(verts);
    RiPointsGeneralPolygonsV(npolys, nloops, nverts, verts, pairs.count(), pairs.tokens.data(),
                             pairs.values.data());
}

RtVoid RiPointsGeneralPolygonsV(RtInt npolys, RtInt nloops[], RtInt nverts[], RtInt verts[],
                                RtInt n, RtToken tokens[], RtPointer parms[]) {
    auto loops = array(nloops, npolys), corners = array(nverts, total(loops));
    send(Request::PointsGeneralPolygons, {loops, corners, array(verts, total(corners))}, n, tokens,
         parms);
}

RtVoid RiSubdivisionMesh(RtToken scheme, RtInt nfaces, RtInt nvertices[], RtInt vertices[],
                         RtInt ntags, RtToken tags[], RtInt nargs[], RtInt intargs[],
                         RtFloat floatargs[], ...) {
    KINORA_PAIRS(floatargs);
    RiSubdivisionMeshV(scheme, nfaces, nvertices, vertices, ntags, tags, nargs, intargs, floatargs,
                       pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiSubdivisionMeshV(RtToken scheme, RtInt nfaces, RtInt nvertices[], RtInt vertices[],
                          RtInt ntags, RtToken tags[], RtInt nargs[], RtInt intargs[],
                          RtFloat floatargs[], RtInt n, RtToken tokens[], RtPointer parms[]) {
    auto faces = array(nvertices, nfaces), counts = array(nargs, 2 * int64_t(ntags));
    int64_t integers = 0, reals = 0;
    for (size_t i = 0; i < counts.size(); ++i) (i % 2 ? reals : integers) += std::max(counts[i], 0);
    send(Request::SubdivisionMesh,
         {scheme, faces, array(vertices, total(faces)), array(tags, ntags), counts,
          array(intargs, integers), array(floatargs, reals)},
         n, tokens, parms);
}
