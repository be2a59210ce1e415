// runtime/scene/ri/calls/patches.cpp: patches and NURBS of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiPatch(RtToken type, ...) {
    KINORA_PAIRS(type);
    RiPatchV(type, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiPatchV(RtToken type, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Patch, {type}, n, tokens, parms);
}

RtVoid RiPatchMesh(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, ...) {
    KINORA_PAIRS(vwrap);
    RiPatchMeshV(type, nu, uwrap, nv, vwrap, pairs.count(), pairs.tokens.data(),
                 pairs.values.data());
}

RtVoid RiPatchMeshV(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, RtInt n,
                    RtToken tokens[], RtPointer parms[]) {
    send(Request::PatchMesh, {type, nu, uwrap, nv, vwrap}, n, tokens, parms);
}

RtVoid RiNuPatch(RtInt nu, RtInt uorder, RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv,
                 RtInt vorder, RtFloat vknot[], RtFloat vmin, RtFloat vmax, ...) {
    KINORA_PAIRS(vmax);
    RiNuPatchV(nu, uorder, uknot, umin, umax, nv, vorder, vknot, vmin, vmax, pairs.count(),
               pairs.tokens.data(), pairs.values.data());
}

RtVoid RiNuPatchV(RtInt nu, RtInt uorder, RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv,
                  RtInt vorder, RtFloat vknot[], RtFloat vmin, RtFloat vmax, RtInt n,
                  RtToken tokens[], RtPointer parms[]) {
    send(Request::NuPatch,
         {nu, uorder, array(uknot, int64_t(nu) + uorder), umin, umax, nv, vorder,
          array(vknot, int64_t(nv) + vorder), vmin, vmax},
         n, tokens, parms);
}
