// tests/runtime/scene/ri/tokens_test.cpp: arguments that are one of a few words, and what is none
// of them.
#include "rib_scene.h"
#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {
namespace {

const std::string kBeginning = "WorldBegin ", kEnding = " WorldEnd";
const std::string kCorners = "\"P\" [0 0 2 1 0 2 0 1 2 1 1 2] ";
const std::string kOneFace = "[4] [0 1 2 3] ";

// A request with % for one word.
struct WordRow {
    Request request;
    size_t argument;  // by its letter in requests.def
    std::string text;
    std::vector<std::string> words;
    std::string code = "RI_TOKEN_WRONG";
};

std::vector<WordRow> in_options() {
    using R = Request;
    return {
        {R::Projection, 0, "Projection \"%\" ", {"perspective", "orthographic", "orthogonal", ""}},
        {R::PixelFilter,
         0,
         "PixelFilter \"%\" 2 2 ",
         {"box", "triangle", "gaussian", "catmull-rom", "sinc", "mitchell", "disk", "bessel"}},
        {R::Display, 1, "Display \"a.png\" \"%\" \"rgb\" ", {"file", "framebuffer", "tiff"}},
        {R::Hider, 0, "Hider \"%\" ", {"hidden", "raytrace", ""}},
        {R::MakeTexture, 2, "MakeTexture \"a\" \"b\" \"%\" \"clamp\" \"box\" 1 1 ", {"black"}},
        {R::MakeTexture, 3, "MakeTexture \"a\" \"b\" \"clamp\" \"%\" \"box\" 1 1 ", {"periodic"}},
        {R::MakeTexture, 4, "MakeTexture \"a\" \"b\" \"clamp\" \"clamp\" \"%\" 1 1 ", {"sinc"}},
        {R::MakeBump, 2, "MakeBump \"a\" \"b\" \"%\" \"clamp\" \"box\" 1 1 ", {"clamp"}},
        {R::MakeBump, 3, "MakeBump \"a\" \"b\" \"clamp\" \"%\" \"box\" 1 1 ", {"black"}},
        {R::MakeBump, 4, "MakeBump \"a\" \"b\" \"clamp\" \"clamp\" \"%\" 1 1 ", {"box"}},
        {R::MakeLatLongEnvironment, 2, "MakeLatLongEnvironment \"a\" \"b\" \"%\" 1 1 ", {"disk"}},
        {R::MakeCubeFaceEnvironment,
         8,
         "MakeCubeFaceEnvironment \"a\" \"b\" \"c\" \"d\" \"e\" \"f\" \"g\" 90 \"%\" 1 1 ",
         {"gaussian"}},
        {R::ErrorHandler, 0, "ErrorHandler \"%\" ", {"ignore", "print", "abort"}, "RIB_ARGUMENT"},
    };
}

std::vector<WordRow> in_worlds() {
    using R = Request;
    const std::vector<std::string> types = {"surface",    "displacement", "deformation",
                                            "atmosphere", "interior",     "exterior"};
    const std::string mesh = "2 \"nonperiodic\" 2 ";
    return {
        {R::SolidBegin, 0, "SolidBegin \"%\" SolidEnd ", {"primitive"}},
        {R::ShadingInterpolation, 0, "ShadingInterpolation \"%\" ", {"constant", "smooth"}},
        {R::GeometricApproximation, 0, "GeometricApproximation \"%\" 1 ", {"flatness"}},
        {R::Orientation, 0, "Orientation \"%\" ", {"outside", "inside", "lh", "rh"}},
        {R::ShaderLayer, 0, "ShaderLayer \"%\" \"null\" \"a\" ", types},
        {R::ConnectShaderLayers, 0, "ConnectShaderLayers \"%\" \"a\" \"b\" \"c\" \"d\" ", {}},
        {R::Basis, 0, "Basis \"%\" 3 \"bezier\" 3 ", {"b-spline", "power"}, "RIB_ARGUMENT"},
        {R::Basis, 2, "Basis \"bezier\" 3 \"%\" 3 ", {"hermite", "catmull-rom"}, "RIB_ARGUMENT"},
        {R::Patch, 0, "Patch \"%\" " + kCorners, {"bilinear"}},
        {R::PatchMesh, 0, "PatchMesh \"%\" " + mesh + "\"nonperiodic\" " + kCorners, {"bilinear"}},
        {R::PatchMesh,
         2,
         "PatchMesh \"bilinear\" 2 \"%\" 2 \"nonperiodic\" " + kCorners,
         {"periodic", "nonperiodic", "nowrap"}},
        {R::PatchMesh,
         4,
         "PatchMesh \"bilinear\" " + mesh + "\"%\" " + kCorners,
         {"periodic", "nonperiodic"}},
        {R::Curves, 0, "Curves \"%\" [4] \"nonperiodic\" " + kCorners, {"linear", "cubic"}},
        {R::Curves, 2, "Curves \"linear\" [4] \"%\" " + kCorners, {"periodic", "nonperiodic"}},
        {R::SubdivisionMesh,
         0,
         "SubdivisionMesh \"%\" " + kOneFace + "[\"interpolateboundary\"] [0 0] [] [] " + kCorners,
         {"catmull-clark", "loop"}},
        {R::SubdivisionMesh,
         3,
         "SubdivisionMesh \"catmull-clark\" " + kOneFace +
             "[\"interpolateboundary\" \"%\"] [0 0 0 0] [] [] " + kCorners,
         {"hole", "crease", "corner", "interpolateboundary"}},
        {R::Geometry, 0, "Geometry \"%\" ", {"teapot"}, "RI_NOT_DONE"},
        {R::Procedural,
         0,
         "Procedural \"%\" [\"a\" \"b\"] [0 1 0 1 0 1] ",
         {"DelayedReadArchive", "RunProgram", "DynamicLoad"},
         "RIB_ARGUMENT"},
    };
}

std::string with(const std::string& text, const std::string& word) {
    const size_t at = text.find('%');
    return text.substr(0, at) + word + text.substr(at + 1);
}

// What the world shows besides the request.
size_t drawn(const RibWorlds& r) {
    return r.primitives().size();
}

// Findings that are not about a word: that a file is missing, or that something is not done.
void expect_words(const WordRow& row, const std::string& before, const std::string& after) {
    const RibWorlds wrong(before + with(row.text, "bogus") + after + kEnding);
    EXPECT_EQ(wrong.count(row.code), 1) << row.text << wrong.findings();
    EXPECT_EQ(wrong.diagnostics.findings().size(), 1u) << row.text << wrong.findings();
    EXPECT_GE(drawn(wrong), 1u) << row.text;
    for (const std::string& word : row.words) {
        const RibWorlds right(before + with(row.text, word) + after + kEnding);
        EXPECT_EQ(right.findings().find("'" + word + "'"), std::string::npos)
            << row.text << word << right.findings();
        EXPECT_EQ(right.count("RI_TOKEN_WRONG"), 0) << row.text << word << right.findings();
    }
}

const std::string kAnyBall = "Sphere 1 -1 1 360 ";

TEST(RiTokens, WrongWordsOfOptionsAreToldOnce) {
    for (const WordRow& row : in_options())
        expect_words(row, "", "Translate 0 0 5 " + kBeginning + kAnyBall);
}

TEST(RiTokens, WrongWordsOfWorldsAreToldOnce) {
    for (const WordRow& row : in_worlds())
        expect_words(row, "Translate 0 0 5 " + kBeginning, kAnyBall);
}

// Names of shaders, files, archives, spaces, variables, handles and renderers' own attributes.
struct NameRow {
    Request request;
    std::string_view arguments;  // n: any name is good there
};
constexpr NameRow kAnyNames[] = {
    {Request::Declare, "nn"},
    {Request::Imager, "n"},
    {Request::Quantize, "n"},
    {Request::Display, "nsn"},
    {Request::Option, "n"},
    {Request::LightSource, "n"},
    {Request::AreaLightSource, "n"},
    {Request::Surface, "n"},
    {Request::Atmosphere, "n"},
    {Request::Interior, "n"},
    {Request::Exterior, "n"},
    {Request::Displacement, "n"},
    {Request::Deformation, "n"},
    {Request::Attribute, "n"},
    {Request::ShaderLayer, "snn"},
    {Request::ConnectShaderLayers, "snnnn"},
    {Request::Shader, "nn"},
    {Request::GeometricRepresentation, "n"},  // of another interface than 3.2
    {Request::CoordinateSystem, "n"},
    {Request::ScopedCoordinateSystem, "n"},
    {Request::CoordSysTransform, "n"},
    {Request::Blobby, "iIFn"},
    {Request::Procedural, "sn"},
    {Request::MakeTexture, "nnsss"},
    {Request::MakeBump, "nnsss"},
    {Request::MakeLatLongEnvironment, "nns"},
    {Request::MakeCubeFaceEnvironment, "nnnnnnnfs"},
    {Request::MakeShadow, "nn"},
    {Request::ArchiveRecord, "sn"},
    {Request::ReadArchive, "n"},
    {Request::ArchiveBegin, "n"},
    {Request::IfBegin, "n"},
    {Request::ElseIf, "n"},
};

bool is_any_name(Request request, size_t argument) {
    for (const NameRow& row : kAnyNames)
        if (row.request == request && argument < row.arguments.size())
            return row.arguments[argument] == 'n';
    return false;
}

bool is_tested(Request request, size_t argument) {
    if (request == Request::ArchiveRecord) return argument == 0;  // RIB has none
    for (const auto& rows : {in_options(), in_worlds()})
        for (const WordRow& row : rows)
            if (row.request == request && row.argument == argument) return true;
    return false;
}

TEST(RiTokens, EveryTextOfARequestIsAWordOrAName) {
    for (size_t k = 0; k < requests().size(); ++k) {
        size_t argument = 0;
        for (char letter : requests()[k].arguments) {
            if (letter == '?' || letter == '*') continue;
            const bool text = letter == 's' || letter == 'S' || letter == 'x';
            EXPECT_EQ(is_tested(Request(k), argument) + is_any_name(Request(k), argument), text)
                << requests()[k].name << " argument " << argument;
            ++argument;
        }
    }
}

// The patch has no other meaning; the solid is its surfaces; the wrap is black.
TEST(RiTokens, WrongWordsLeaveOutPrimitivesAlone) {
    EXPECT_EQ(drawn(RibWorlds(kBeginning + "Patch \"bogus\" " + kCorners + kEnding)), 0u);
    EXPECT_EQ(drawn(RibWorlds(kBeginning + "Patch \"bilinear\" " + kCorners + kEnding)), 1u);
    EXPECT_EQ(
        drawn(RibWorlds(kBeginning + "SolidBegin \"bogus\" " + kAnyBall + "SolidEnd" + kEnding)),
        1u);
}

TEST(RiTokens, WrongWordsAreTakenForTheDefault) {
    const RibWorlds filter("PixelFilter \"bogus\" 3 3 " + kBeginning + kEnding);
    EXPECT_EQ(filter.picture().filter, "gaussian");
    EXPECT_EQ(filter.picture().filter_width, 3);
    const std::string bent = "Projection \"bogus\" \"fov\" 10 ",
                      ball = kBeginning + kAnyBall + kEnding;
    EXPECT_TRUE(RibWorlds(bent + ball).world().cameras[0].orthographic);
}

TEST(RiTokens, AnOrientationStaysWhereTheNewOneIsNone) {
    const auto normal = [](const std::string& orientation) {
        const RibWorlds r(kBeginning + orientation + "Polygon \"P\" [0 0 2 0 1 2 1 0 2] " +
                          kEnding);
        return r.primitive().mesh->groups.at(0).triangles;
    };
    EXPECT_EQ(normal("Orientation \"inside\" Orientation \"bogus\" "),
              normal("Orientation \"inside\" "));
    EXPECT_NE(normal("Orientation \"inside\" "), normal(""));
}

TEST(RiTokens, AttributesHaveWordsToo) {
    for (const char* attribute :
         {"\"light\" \"string shadows\" \"bogus\"", "\"trimcurve\" \"string sense\" \"bogus\"",
          "\"render\" \"string casts_shadows\" \"bogus\"",
          "\"visibility\" \"string transmission\" \"bogus\""}) {
        const RibWorlds r(kBeginning + "Attribute " + attribute + kEnding);
        EXPECT_EQ(r.count("RI_TOKEN_WRONG"), 1) << attribute << r.findings();
    }
    EXPECT_EQ(RibWorlds(kBeginning + "Attribute \"other\" \"string shadows\" \"bogus\"" + kEnding)
                  .findings(),
              "");
}

TEST(RiTokens, InFilmsAndObjectsTheyAreToldOnce) {
    const std::string object = "ObjectBegin 1 SolidBegin \"bogus\" SolidEnd ObjectEnd ";
    const RibWorlds r(object + kBeginning + "ObjectInstance 1 ObjectInstance 1" + kEnding +
                      kBeginning + "ObjectInstance 1" + kEnding);
    EXPECT_EQ(r.count("RI_TOKEN_WRONG"), 1) << r.findings();
}

TEST(RiTokens, HidersThatHideNothingAreNotDone) {
    for (const char* hider : {"Hider \"paint\" ", "Hider \"null\" "})
        EXPECT_EQ(RibWorlds(hider + kBeginning + kEnding).count("RI_NOT_DONE"), 1) << hider;
}

}  // namespace
}  // namespace kinora::ri
