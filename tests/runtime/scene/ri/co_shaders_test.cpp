// tests/runtime/scene/ri/co_shaders_test.cpp: shaders that find others by their handles, and layers
// that hand values on.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

// Clockwise as seen from the eye, from -1 to 1 at z = 3.
const std::string kWall = "Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] ";

class RiCoShaders : public testing::Test {
  protected:
    RiCoShaders() {
        folder_
            .file("paint.sl",
                  "class paint(color tint = color(1, 0, 0); string __category = \"paints\";"
                  " point spot = 0;) {"
                  " public void paint_it(output color c;) { c = tint; }"
                  " public void place_it(output color c;) { point p = transform(\"camera\", spot);"
                  "   c = 0.5 + 0.5 * color(xcomp(p), ycomp(p), zcomp(p)); } }")
            .file("painted.sl",
                  "class painted(string under = \"base\"; float place = 0;) {"
                  " public void surface(output color Ci, Oi) { shader s = getshader(under);"
                  "   color c = color(0, 0, 0.5); if (s != null) { if (place > 0) s->place_it(c);"
                  "   else s->paint_it(c); } Oi = 1; Ci = c; } }")
            .file(
                "by_handle.sl",
                "class by_handle(shader base = null;) { public void surface(output color Ci, Oi) {"
                " color c = color(0, 0, 0.5); if (base != null) base->paint_it(c);"
                " Oi = 1; Ci = c; } }")
            .file("counted.sl",
                  "class counted() { public void surface(output color Ci, Oi) {"
                  " shader all[] = getshaders(\"category\", \"paints\");"
                  " Oi = 1; Ci = arraylength(all) / 4; } }")
            .file("lengths.sl",
                  "surface lengths(float list[] = {};) { Oi = 1; Ci = arraylength(list) / 4; }")
            .file("texels.sl",
                  "surface texels(output color Cout = 0; output float amount = 0;"
                  " output varying float many[2] = {0, 0};)"
                  "{ Cout = color(s, t, 0.25); amount = 0.5; many[0] = s; many[1] = 0.75;"
                  "  Ci = 0; Oi = 0; }")
            .file("cs.sl", "surface cs() { Oi = Os; Ci = Os * Cs; }")
            .file("scaled.sl",
                  "surface scaled(float k = 1; color c = 1; float two[2] = {1, 1};)"
                  "{ Oi = 1; Ci = k * c * two[1]; }");
    }
    RibPicture picture(const std::string& inside, const std::string& before = "") const {
        return RibPicture(kSmall + folder_.search() + before + "WorldBegin " + inside +
                          " WorldEnd");
    }
    void shows(const std::string& inside, dvec3 color, const std::string& before = "") const {
        RibPicture r = picture(inside, before);
        EXPECT_EQ(r.findings(), "") << inside;
        SCOPED_TRACE(inside);
        expect_near(dvec3(vec3(r.at(8, 7))), color);
    }
    RibWorlds worlds(const std::string& inside) const {
        return RibWorlds(folder_.search() + "WorldBegin " + inside + " WorldEnd");
    }

    RibFolder folder_;
};

TEST_F(RiCoShaders, AreFoundByTheirHandles) {
    const std::string base = "Shader \"paint\" \"base\" \"color tint\" [0 1 .5] ";
    shows(base + "Surface \"painted\" " + kWall, {0, 1, .5});
    shows("Surface \"painted\" " + kWall, {0, 0, .5});
    shows("Shader \"paint\" \"base\" Surface \"painted\" " + kWall, {1, 0, 0});
    shows("Shader \"paint\" \"b\" \"tint\" [0 1 0] Surface \"painted\" \"under\" \"b\" " + kWall,
          {0, 1, 0});
    shows(base + "Surface \"by_handle\" \"base\" \"base\" " + kWall, {0, 1, .5});
    shows(base + "Surface \"by_handle\" " + kWall, {0, 0, .5});
}

// A surface sees those that were there when it was bound.
TEST_F(RiCoShaders, AreAttributes) {
    const std::string red = "Shader \"paint\" \"base\" \"tint\" [1 0 0] ",
                      green = "Shader \"paint\" \"base\" \"tint\" [0 1 0] ",
                      painted = "Surface \"painted\" ";
    shows(red + green + painted + kWall, {0, 1, 0});
    shows(red + painted + green + kWall, {1, 0, 0});
    shows(red + "AttributeBegin " + green + "AttributeEnd " + painted + kWall, {1, 0, 0});
    shows(red + "AttributeBegin " + green + painted + kWall + "AttributeEnd ", {0, 1, 0});
    shows(painted + kWall, {1, 0, 0}, red);
}

TEST_F(RiCoShaders, AreFoundByCategory) {
    const std::string one = "Shader \"paint\" \"a\" ", two = "Shader \"paint\" \"b\" ",
                      other = "Shader \"paint\" \"c\" \"__category\" \"metals\" ";
    shows(one + two + other + "Surface \"counted\" " + kWall, dvec3(.5));
    shows("Surface \"counted\" " + kWall, dvec3(0));
}

TEST_F(RiCoShaders, PlacesAreOfTheSpaceInWhichTheyStand) {
    shows(
        "TransformBegin Translate .5 0 0 Shader \"paint\" \"base\" \"spot\" [0 .5 0] TransformEnd "
        "Translate 0 0 1 Surface \"painted\" \"place\" 1 Translate 0 0 -1 " +
            kWall,
        {.75, .75, .5});
}

TEST_F(RiCoShaders, ManySurfacesShareOneLinkedShader) {
    RibWorlds r = worlds("Shader \"paint\" \"base\" Surface \"painted\" " + kWall +
                         "Shader \"paint\" \"base\" \"tint\" [0 1 0] Surface \"painted\" " + kWall);
    EXPECT_EQ(r.primitive(0).material->surfaces[0].shader,
              r.primitive(1).material->surfaces[0].shader);
    EXPECT_EQ(r.findings(), "");
}

TEST_F(RiCoShaders, WhatIsWrongIsToldOnce) {
    RibWorlds r = worlds(
        "Shader \"nowhere_there\" \"base\" Shader \"nowhere_there\" \"base\" "
        "Shader \"paint\" \"a.b\" Shader \"paint\" \"\" Surface \"painted\" " +
        kWall);
    EXPECT_EQ(r.count("RI_SHADER_UNKNOWN"), 1) << r.findings();
    EXPECT_EQ(r.count("RI_RANGE"), 2) << r.findings();
    EXPECT_EQ(r.primitives().size(), 1u);
}

TEST_F(RiCoShaders, OpenArraysAreAsLongAsWhatIsGiven) {
    shows("Surface \"lengths\" \"float[3] list\" [1 2 3] " + kWall, dvec3(.75));
    shows("Surface \"lengths\" " + kWall, dvec3(0));
}

const std::string kTexels = "ShaderLayer \"surface\" \"texels\" \"one\" ";
std::string connected(const std::string& from, const std::string& to) {
    return "ConnectShaderLayers \"surface\" \"one\" \"" + from + "\" \"two\" \"" + to + "\" ";
}

// s and t of a polygon are x and y of its space.
TEST_F(RiCoShaders, LayersGetWhatLayersBelowLeave) {
    const dvec3 texel(1 / 16.0, 1 / 16.0, .25);
    shows(kTexels + "ShaderLayer \"surface\" \"cs\" \"two\" " + connected("Cout", "Cs") + kWall,
          texel);
    shows("Color 1 0 1 " + kTexels + "ShaderLayer \"surface\" \"scaled\" \"two\" " +
              connected("Cout", "c") + connected("amount", "k") + kWall,
          texel * .5);
    shows(
        kTexels + "ShaderLayer \"surface\" \"scaled\" \"two\" " + connected("many", "two") + kWall,
        dvec3(.75));
    shows(kTexels +
              "ShaderLayer \"surface\" \"cs\" \"three\" ShaderLayer \"surface\" \"scaled\" "
              "\"two\" " +
              connected("amount", "c") + kWall,
          dvec3(.5));
}

TEST_F(RiCoShaders, ConnectionsWinOverWhatIsBound) {
    shows(kTexels + "ShaderLayer \"surface\" \"scaled\" \"two\" \"k\" 7 " +
              connected("many", "two") + connected("amount", "k") + kWall,
          dvec3(.375));
}

TEST_F(RiCoShaders, WhatCannotBeConnectedIsTold) {
    const std::string both = kTexels + "ShaderLayer \"surface\" \"scaled\" \"two\" ";
    for (const std::string& wrong :
         {std::string("ConnectShaderLayers \"surface\" \"two\" \"k\" \"one\" \"amount\" "),
          std::string("ConnectShaderLayers \"surface\" \"none\" \"k\" \"two\" \"k\" "),
          std::string("ConnectShaderLayers \"surface\" \"one\" \"amount\" \"none\" \"k\" "),
          connected("nothing", "k"), connected("amount", "nothing"), connected("many", "k"),
          connected("Cout", "k")}) {
        RibWorlds r = worlds(both + wrong + kWall);
        EXPECT_EQ(r.count("RI_RANGE"), 1) << wrong << r.findings();
        EXPECT_TRUE(r.primitive(0).material->surfaces[1].links.empty()) << wrong;
    }
}

}  // namespace
}  // namespace kinora::ri
