// runtime/scene/ri/calls/tokens.cpp: the tokens of ri.h.
#include "runtime/scene/ri/calls/ri.h"

namespace {

// The binding has no const.
RtToken token(const char* text) {
    return const_cast<RtToken>(text);
}

}  // namespace

extern "C" {
RtToken RI_A = token("a");
RtToken RI_ABORT = token("abort");
RtToken RI_AMBIENTLIGHT = token("ambientlight");
RtToken RI_AMPLITUDE = token("amplitude");
RtToken RI_AZ = token("az");
RtToken RI_BACKGROUND = token("background");
RtToken RI_BEAMDISTRIBUTION = token("beamdistribution");
RtToken RI_BICUBIC = token("bicubic");
RtToken RI_BILINEAR = token("bilinear");
RtToken RI_BLACK = token("black");
RtToken RI_BUMPY = token("bumpy");
RtToken RI_CAMERA = token("camera");
RtToken RI_CLAMP = token("clamp");
RtToken RI_COMMENT = token("comment");
RtToken RI_CONEANGLE = token("coneangle");
RtToken RI_CONEDELTAANGLE = token("conedeltaangle");
RtToken RI_CONSTANT = token("constant");
RtToken RI_CONSTANTWIDTH = token("constantwidth");
RtToken RI_CS = token("Cs");
RtToken RI_CUBIC = token("cubic");
RtToken RI_CURRENT = token("current");
RtToken RI_DEPTHCUE = token("depthcue");
RtToken RI_DIFFERENCE = token("difference");
RtToken RI_DISTANCE = token("distance");
RtToken RI_DISTANTLIGHT = token("distantlight");
RtToken RI_FILE = token("file");
RtToken RI_FLATNESS = token("flatness");
RtToken RI_FOG = token("fog");
RtToken RI_FOV = token("fov");
RtToken RI_FRAMEBUFFER = token("framebuffer");
RtToken RI_FROM = token("from");
RtToken RI_HANDLER = token("handler");
RtToken RI_HIDDEN = token("hidden");
RtToken RI_IDENTIFIER = token("identifier");
RtToken RI_IGNORE = token("ignore");
RtToken RI_INSIDE = token("inside");
RtToken RI_INTENSITY = token("intensity");
RtToken RI_INTERSECTION = token("intersection");
RtToken RI_KA = token("Ka");
RtToken RI_KD = token("Kd");
RtToken RI_KR = token("Kr");
RtToken RI_KS = token("Ks");
RtToken RI_LH = token("lh");
RtToken RI_LIGHTCOLOR = token("lightcolor");
RtToken RI_LINEAR = token("linear");
RtToken RI_MATTE = token("matte");
RtToken RI_MAXDISTANCE = token("maxdistance");
RtToken RI_METAL = token("metal");
RtToken RI_MINDISTANCE = token("mindistance");
RtToken RI_N = token("N");
RtToken RI_NAME = token("name");
RtToken RI_NONPERIODIC = token("nonperiodic");
RtToken RI_NP = token("Np");
RtToken RI_OBJECT = token("object");
RtToken RI_ORIGIN = token("origin");
RtToken RI_ORTHOGRAPHIC = token("orthographic");
RtToken RI_OS = token("Os");
RtToken RI_OUTSIDE = token("outside");
RtToken RI_P = token("P");
RtToken RI_PAINT = token("paint");
RtToken RI_PAINTEDPLASTIC = token("paintedplastic");
RtToken RI_PERIODIC = token("periodic");
RtToken RI_PERSPECTIVE = token("perspective");
RtToken RI_PLASTIC = token("plastic");
RtToken RI_POINTLIGHT = token("pointlight");
RtToken RI_PRIMITIVE = token("primitive");
RtToken RI_PRINT = token("print");
RtToken RI_PW = token("Pw");
RtToken RI_PZ = token("Pz");
RtToken RI_RASTER = token("raster");
RtToken RI_RGB = token("rgb");
RtToken RI_RGBA = token("rgba");
RtToken RI_RGBAZ = token("rgbaz");
RtToken RI_RGBZ = token("rgbz");
RtToken RI_RH = token("rh");
RtToken RI_ROUGHNESS = token("roughness");
RtToken RI_S = token("s");
RtToken RI_SCREEN = token("screen");
RtToken RI_SHADER = token("shader");
RtToken RI_SHINYMETAL = token("shinymetal");
RtToken RI_SMOOTH = token("smooth");
RtToken RI_SPECULARCOLOR = token("specularcolor");
RtToken RI_SPOTLIGHT = token("spotlight");
RtToken RI_ST = token("st");
RtToken RI_STRUCTURE = token("structure");
RtToken RI_T = token("t");
RtToken RI_TEXTURENAME = token("texturename");
RtToken RI_TO = token("to");
RtToken RI_UNION = token("union");
RtToken RI_VERBATIM = token("verbatim");
RtToken RI_WIDTH = token("width");
RtToken RI_WORLD = token("world");
RtToken RI_Z = token("z");
}
