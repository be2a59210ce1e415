// runtime/scene/ri/calls/picture.cpp: options of the picture of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

RtVoid RiPixelVariance(RtFloat variation) {
    send(Request::PixelVariance, {variation});
}

RtVoid RiPixelSamples(RtFloat xsamples, RtFloat ysamples) {
    send(Request::PixelSamples, {xsamples, ysamples});
}

RtVoid RiPixelFilter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth) {
    send(Request::PixelFilter, {filter_values(function), xwidth, ywidth});
}

RtVoid RiExposure(RtFloat gain, RtFloat gamma) {
    send(Request::Exposure, {gain, gamma});
}

RtVoid RiImager(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiImagerV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiImagerV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Imager, {name}, n, tokens, parms);
}

RtVoid RiQuantize(RtToken type, RtInt one, RtInt min, RtInt max, RtFloat amplitude) {
    send(Request::Quantize, {type, one, min, max, amplitude});
}

RtVoid RiDisplay(char* name, RtToken type, RtToken mode, ...) {
    KINORA_PAIRS(mode);
    RiDisplayV(name, type, mode, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiDisplayV(char* name, RtToken type, RtToken mode, RtInt n, RtToken tokens[],
                  RtPointer parms[]) {
    send(Request::Display, {name, type, mode}, n, tokens, parms);
}

RtVoid RiHider(RtToken type, ...) {
    KINORA_PAIRS(type);
    RiHiderV(type, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiHiderV(RtToken type, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Hider, {type}, n, tokens, parms);
}

RtVoid RiColorSamples(RtInt n, RtFloat nRGB[], RtFloat RGBn[]) {
    send(Request::ColorSamples, {array(nRGB, 3 * int64_t(n)), array(RGBn, 3 * int64_t(n))});
}

RtVoid RiRelativeDetail(RtFloat relativedetail) {
    send(Request::RelativeDetail, {relativedetail});
}

RtVoid RiOption(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiOptionV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiOptionV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    const Values arguments[] = {name};
    current_or_outside().send(Request::Option, arguments, n, tokens, parms);
}
