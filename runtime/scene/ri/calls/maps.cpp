// runtime/scene/ri/calls/maps.cpp: maps of textures of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiMakeTexture(char* picture, char* texture, RtToken swrap, RtToken twrap,
                     RtFilterFunc filter, RtFloat swidth, RtFloat twidth, ...) {
    KINORA_PAIRS(twidth);
    RiMakeTextureV(picture, texture, swrap, twrap, filter, swidth, twidth, pairs.count(),
                   pairs.tokens.data(), pairs.values.data());
}

RtVoid RiMakeTextureV(char* picture, char* texture, RtToken swrap, RtToken twrap,
                      RtFilterFunc filter, RtFloat swidth, RtFloat twidth, RtInt n,
                      RtToken tokens[], RtPointer parms[]) {
    send(Request::MakeTexture,
         {picture, texture, swrap, twrap, filter_values(filter), swidth, twidth}, n, tokens, parms);
}

RtVoid RiMakeBump(char* picture, char* texture, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                  RtFloat swidth, RtFloat twidth, ...) {
    KINORA_PAIRS(twidth);
    RiMakeBumpV(picture, texture, swrap, twrap, filter, swidth, twidth, pairs.count(),
                pairs.tokens.data(), pairs.values.data());
}

RtVoid RiMakeBumpV(char* picture, char* texture, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                   RtFloat swidth, RtFloat twidth, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::MakeBump, {picture, texture, swrap, twrap, filter_values(filter), swidth, twidth},
         n, tokens, parms);
}

RtVoid RiMakeLatLongEnvironment(char* picture, char* texture, RtFilterFunc filter, RtFloat swidth,
                                RtFloat twidth, ...) {
    KINORA_PAIRS(twidth);
    RiMakeLatLongEnvironmentV(picture, texture, filter, swidth, twidth, pairs.count(),
                              pairs.tokens.data(), pairs.values.data());
}

RtVoid RiMakeLatLongEnvironmentV(char* picture, char* texture, RtFilterFunc filter, RtFloat swidth,
                                 RtFloat twidth, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::MakeLatLongEnvironment, {picture, texture, filter_values(filter), swidth, twidth},
         n, tokens, parms);
}

RtVoid RiMakeCubeFaceEnvironment(char* px, char* nx, char* py, char* ny, char* pz, char* nz,
                                 char* texture, RtFloat fov, RtFilterFunc filter, RtFloat swidth,
                                 RtFloat twidth, ...) {
    KINORA_PAIRS(twidth);
    RiMakeCubeFaceEnvironmentV(px, nx, py, ny, pz, nz, texture, fov, filter, swidth, twidth,
                               pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiMakeCubeFaceEnvironmentV(char* px, char* nx, char* py, char* ny, char* pz, char* nz,
                                  char* texture, RtFloat fov, RtFilterFunc filter, RtFloat swidth,
                                  RtFloat twidth, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::MakeCubeFaceEnvironment,
         {px, nx, py, ny, pz, nz, texture, fov, filter_values(filter), swidth, twidth}, n, tokens,
         parms);
}

RtVoid RiMakeShadow(char* picture, char* texture, ...) {
    KINORA_PAIRS(texture);
    RiMakeShadowV(picture, texture, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiMakeShadowV(char* picture, char* texture, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::MakeShadow, {picture, texture}, n, tokens, parms);
}
