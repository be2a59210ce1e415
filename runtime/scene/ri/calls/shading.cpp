// runtime/scene/ri/calls/shading.cpp: attributes of shading of ri.h.
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;

namespace {

// The numbers of a colour.
int64_t samples() {
    Context* context = Context::current();
    return context ? context->count_state().color_samples : 0;
}

}  // namespace

RtVoid RiColor(RtColor color) {
    send(Request::Color, {array(color, samples())});
}

RtVoid RiOpacity(RtColor color) {
    send(Request::Opacity, {array(color, samples())});
}

RtVoid RiTextureCoordinates(RtFloat s1, RtFloat t1, RtFloat s2, RtFloat t2, RtFloat s3, RtFloat t3,
                            RtFloat s4, RtFloat t4) {
    send(Request::TextureCoordinates, {s1, t1, s2, t2, s3, t3, s4, t4});
}

RtLightHandle RiLightSource(RtToken name, ...) {
    KINORA_PAIRS(name);
    return RiLightSourceV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtLightHandle RiLightSourceV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    return send_new(Request::LightSource, {name}, 1, n, tokens, parms);
}

RtLightHandle RiAreaLightSource(RtToken name, ...) {
    KINORA_PAIRS(name);
    return RiAreaLightSourceV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtLightHandle RiAreaLightSourceV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    return send_new(Request::AreaLightSource, {name}, 1, n, tokens, parms);
}

RtVoid RiIlluminate(RtLightHandle light, RtBoolean onoff) {
    send_handle(Request::Illuminate, light, {int(onoff)});
}

RtVoid RiSurface(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiSurfaceV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiSurfaceV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Surface, {name}, n, tokens, parms);
}

RtVoid RiAtmosphere(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiAtmosphereV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiAtmosphereV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Atmosphere, {name}, n, tokens, parms);
}

RtVoid RiInterior(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiInteriorV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiInteriorV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Interior, {name}, n, tokens, parms);
}

RtVoid RiExterior(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiExteriorV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiExteriorV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Exterior, {name}, n, tokens, parms);
}

RtVoid RiDisplacement(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiDisplacementV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiDisplacementV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Displacement, {name}, n, tokens, parms);
}

RtVoid RiDeformation(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiDeformationV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiDeformationV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Deformation, {name}, n, tokens, parms);
}

RtVoid RiShadingRate(RtFloat size) {
    send(Request::ShadingRate, {size});
}

RtVoid RiShadingInterpolation(RtToken type) {
    send(Request::ShadingInterpolation, {type});
}

RtVoid RiMatte(RtBoolean onoff) {
    send(Request::Matte, {int(onoff)});
}

RtVoid RiAttribute(RtToken name, ...) {
    KINORA_PAIRS(name);
    RiAttributeV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiAttributeV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Attribute, {name}, n, tokens, parms);
}

RtVoid RiShaderLayer(RtToken type, RtToken name, RtToken layer, ...) {
    KINORA_PAIRS(layer);
    RiShaderLayerV(type, name, layer, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiShaderLayerV(RtToken type, RtToken name, RtToken layer, RtInt n, RtToken tokens[],
                      RtPointer parms[]) {
    send(Request::ShaderLayer, {type, name, layer}, n, tokens, parms);
}

RtVoid RiConnectShaderLayers(RtToken type, RtToken layer1, RtToken variable1, RtToken layer2,
                             RtToken variable2) {
    send(Request::ConnectShaderLayers, {type, layer1, variable1, layer2, variable2});
}

RtVoid RiShader(RtToken name, RtToken handle, ...) {
    KINORA_PAIRS(handle);
    RiShaderV(name, handle, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiShaderV(RtToken name, RtToken handle, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::Shader, {name, handle}, n, tokens, parms);
}
