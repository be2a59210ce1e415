// runtime/scene/ri/calls/quadrics.cpp: quadrics of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiSphere(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...) {
    KINORA_PAIRS(thetamax);
    RiSphereV(radius, zmin, zmax, thetamax, pairs.count(), pairs.tokens.data(),
              pairs.values.data());
}

RtVoid RiSphereV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n,
                 RtToken tokens[], RtPointer parms[]) {
    send(Request::Sphere, {radius, zmin, zmax, thetamax}, n, tokens, parms);
}

RtVoid RiCone(RtFloat height, RtFloat radius, RtFloat thetamax, ...) {
    KINORA_PAIRS(thetamax);
    RiConeV(height, radius, thetamax, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiConeV(RtFloat height, RtFloat radius, RtFloat thetamax, RtInt n, RtToken tokens[],
               RtPointer parms[]) {
    send(Request::Cone, {height, radius, thetamax}, n, tokens, parms);
}

RtVoid RiCylinder(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...) {
    KINORA_PAIRS(thetamax);
    RiCylinderV(radius, zmin, zmax, thetamax, pairs.count(), pairs.tokens.data(),
                pairs.values.data());
}

RtVoid RiCylinderV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n,
                   RtToken tokens[], RtPointer parms[]) {
    send(Request::Cylinder, {radius, zmin, zmax, thetamax}, n, tokens, parms);
}

RtVoid RiHyperboloid(RtPoint point1, RtPoint point2, RtFloat thetamax, ...) {
    KINORA_PAIRS(thetamax);
    RiHyperboloidV(point1, point2, thetamax, pairs.count(), pairs.tokens.data(),
                   pairs.values.data());
}

RtVoid RiHyperboloidV(RtPoint point1, RtPoint point2, RtFloat thetamax, RtInt n, RtToken tokens[],
                      RtPointer parms[]) {
    if (!point1 || !point2) return tell_missing(Request::Hyperboloid, "points");
    send(Request::Hyperboloid,
         {point1[0], point1[1], point1[2], point2[0], point2[1], point2[2], thetamax}, n, tokens,
         parms);
}

RtVoid RiParaboloid(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...) {
    KINORA_PAIRS(thetamax);
    RiParaboloidV(rmax, zmin, zmax, thetamax, pairs.count(), pairs.tokens.data(),
                  pairs.values.data());
}

RtVoid RiParaboloidV(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n,
                     RtToken tokens[], RtPointer parms[]) {
    send(Request::Paraboloid, {rmax, zmin, zmax, thetamax}, n, tokens, parms);
}

RtVoid RiDisk(RtFloat height, RtFloat radius, RtFloat thetamax, ...) {
    KINORA_PAIRS(thetamax);
    RiDiskV(height, radius, thetamax, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiDiskV(RtFloat height, RtFloat radius, RtFloat thetamax, RtInt n, RtToken tokens[],
               RtPointer parms[]) {
    send(Request::Disk, {height, radius, thetamax}, n, tokens, parms);
}

RtVoid RiTorus(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax,
               RtFloat thetamax, ...) {
    KINORA_PAIRS(thetamax);
    RiTorusV(majorradius, minorradius, phimin, phimax, thetamax, pairs.count(), pairs.tokens.data(),
             pairs.values.data());
}

RtVoid RiTorusV(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax,
                RtFloat thetamax, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Torus, {majorradius, minorradius, phimin, phimax, thetamax}, n, tokens, parms);
}
