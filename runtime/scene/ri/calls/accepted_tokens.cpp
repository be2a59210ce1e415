// runtime/scene/ri/calls/accepted_tokens.cpp: which words the arguments of requests may be.
#include "runtime/scene/ri/calls/accepted_tokens.h"

#include <fmt/format.h>

#include <algorithm>

namespace kinora::ri {
namespace {

using Words = std::string_view[];

constexpr Words kProjections = {"perspective", "orthographic"};
constexpr Words kOtherProjections = {"orthogonal", ""};
constexpr Words kHiders = {"hidden", "paint", "null"};
constexpr Words kOtherHiders = {"raytrace", "stochastic", "zbuffer", "depthmask", "photon", ""};
constexpr Words kDisplays = {"framebuffer", "file"};
constexpr Words kOtherDisplays = {
    "zframebuffer", "zfile", "shadow", "deepshad", "tiff", "tif",     "TIFF", "exr",
    "openexr",      "png",   "jpeg",   "jpg",      "tga",  "targa",   "bmp",  "gif",
    "sgi",          "sgif",  "iff",    "alias",    "ppm",  "cineon",  "rla",  "pic",
    "softimage",    "it",    "x11",    "windows",  "null", "debugdd", ""};
constexpr Words kInterpolations = {"constant", "smooth"};
constexpr Words kApproximations = {"flatness"};
constexpr Words kOtherApproximations = {"motionfactor", "focusfactor"};
constexpr Words kOrientations = {"outside", "inside", "lh", "rh"};
constexpr Words kSolids = {"primitive", "intersection", "union", "difference"};
constexpr Words kLayerTypes = {"surface",    "displacement", "deformation",
                               "atmosphere", "interior",     "exterior"};
constexpr Words kPatches = {"bilinear", "bicubic"};
constexpr Words kCurves = {"linear", "cubic"};
constexpr Words kWraps = {"periodic", "nonperiodic"};
constexpr Words kOtherWraps = {"nowrap"};
constexpr Words kSchemes = {"catmull-clark"};
constexpr Words kOtherSchemes = {"loop", "bilinear"};
constexpr Words kTags = {"hole", "crease", "corner", "interpolateboundary"};
constexpr Words kOtherTags = {"facevaryinginterpolateboundary",
                              "facevaryingpropagatecorners",
                              "creasemethod",
                              "smoothtriangles",
                              "vertexedit",
                              "edgeedit",
                              "faceedit"};
constexpr Words kMapWraps = {"periodic", "black", "clamp"};
constexpr Words kRecords = {"comment", "structure", "verbatim"};

constexpr std::span<const std::string_view> kNoOther;
constexpr std::string_view kLeftOut = "it is left out", kStays = "what it sets stays as it was",
                           kBlack = "it is taken for \"black\"";

// Names of shaders, files, spaces and variables are any, and so are those of filters and bases,
// which the reader of files judges.
constexpr AcceptedTokens kAccepted[] = {
    {Request::Projection, 0, kProjections, kOtherProjections, "it is taken for \"orthographic\"",
     false},
    {Request::Hider, 0, kHiders, kOtherHiders, "it is taken for \"hidden\"", false},
    {Request::Display, 1, kDisplays, kOtherDisplays, "it is taken for \"file\"", false},
    {Request::SolidBegin, 0, kSolids, kNoOther, "it is taken for \"primitive\"", false},
    {Request::SubdivisionMesh, 0, kSchemes, kOtherSchemes, "it is taken for \"catmull-clark\"",
     false},
    {Request::SubdivisionMesh, 3, kTags, kOtherTags, "the tag is left out", false},
    {Request::MakeTexture, 2, kMapWraps, kNoOther, kBlack, false},
    {Request::MakeTexture, 3, kMapWraps, kNoOther, kBlack, false},
    {Request::MakeBump, 2, kMapWraps, kNoOther, kBlack, false},
    {Request::MakeBump, 3, kMapWraps, kNoOther, kBlack, false},
    {Request::ShadingInterpolation, 0, kInterpolations, kNoOther, kStays, true},
    {Request::GeometricApproximation, 0, kApproximations, kOtherApproximations, kLeftOut, true},
    {Request::Orientation, 0, kOrientations, kNoOther, kStays, true},
    {Request::ShaderLayer, 0, kLayerTypes, kNoOther, kLeftOut, true},
    {Request::ConnectShaderLayers, 0, kLayerTypes, kNoOther, kLeftOut, true},
    {Request::Patch, 0, kPatches, kNoOther, kLeftOut, true},
    {Request::PatchMesh, 0, kPatches, kNoOther, kLeftOut, true},
    {Request::PatchMesh, 2, kWraps, kOtherWraps, kLeftOut, true},
    {Request::PatchMesh, 4, kWraps, kOtherWraps, kLeftOut, true},
    {Request::Curves, 0, kCurves, kNoOther, kLeftOut, true},
    {Request::Curves, 2, kWraps, kOtherWraps, kLeftOut, true},
    {Request::ArchiveRecord, 0, kRecords, kNoOther, "it is taken for \"comment\"", false},
};

bool accepts(const AcceptedTokens& row, std::string_view token) {
    return std::ranges::count(row.words, token) || std::ranges::count(row.other, token);
}

}  // namespace

std::span<const AcceptedTokens> accepted_tokens() {
    return kAccepted;
}

std::string words_of(const AcceptedTokens& row) {
    return fmt::format("{}", fmt::join(row.words, ", "));
}

std::vector<WrongToken> wrong_tokens(Request request, std::span<const Values> arguments) {
    std::vector<WrongToken> wrong;
    for (const AcceptedTokens& row : kAccepted)
        if (row.request == request && row.argument < arguments.size())
            for (std::string_view token : arguments[row.argument].strings())
                if (!accepts(row, token)) wrong.push_back({&row, token});
    return wrong;
}

std::optional<WrongToken> refusal(Request request, std::span<const Values> arguments) {
    if (row(request).kind != RequestClass::Primitive) return std::nullopt;
    for (const WrongToken& wrong : wrong_tokens(request, arguments))
        if (wrong.row->left_out) return wrong;
    return std::nullopt;
}

}  // namespace kinora::ri
