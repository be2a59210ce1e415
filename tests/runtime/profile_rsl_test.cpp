// tests/runtime/profile_rsl_test.cpp: each thing that can be wrong between an effect and its
// shaders has its code and place; what is right has none.
#include <gtest/gtest.h>

#include "runtime/scene/profile_rsl/check.h"
#include "tests/collada/reading.h"

namespace kinora {

namespace {

using collada::Reading;

const char* kCode =
    "surface s(float Kd = 1; color tint = 1; string map = \"\"; float four[4] = {1, 2, 3, 4};) {"
    " Ci = Kd * tint * diffuse(N) * four[1]; Oi = 1; }";

struct Parts {
    std::string code = kCode;
    std::string params = "<newparam sid=\"kd\"><float>0.5</float></newparam>";
    std::string pass =
        "<shader stage=\"SURFACE\"><name>s</name><bind symbol=\"Kd\"><param ref=\"kd\"/></bind>"
        "</shader>";
    std::string setparams;
    std::string binds;  // of the instance_material
};

void check(Reading& r, const Parts& parts) {
    std::string mesh =
        "<library_geometries><geometry id=\"g\"><mesh>" +
        collada::float_source("pos", "0 0 0 1 0 0 0 1 0", 3, "XYZ") +
        "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#pos\"/></vertices><triangles "
        "material=\"m\" count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 "
        "2</p></triangles></mesh></geometry></library_geometries>";
    std::string effect =
        "<library_effects><effect id=\"e\"><profile_RSL>" + parts.params +
        "<technique sid=\"t\"><code><![CDATA[" + parts.code + "]]></code><pass>" + parts.pass +
        "</pass></technique></profile_RSL></effect></library_effects><library_materials><material "
        "id=\"mat\"><instance_effect url=\"#e\">" +
        parts.setparams + "</instance_effect></material></library_materials>";
    collada::read_text(
        r, collada::with_scene(
               effect + mesh,
               "<node id=\"n\"><instance_geometry url=\"#g\"><bind_material><technique_common>"
               "<instance_material symbol=\"m\" target=\"#mat\">" +
                   parts.binds +
                   "</instance_material></technique_common></bind_material></instance_geometry>"
                   "</node>"));
    ASSERT_TRUE(r.scene);
    check_profile_rsl(*r.scene, {}, r.diag);
}

void expect(const Parts& parts, const char* code, const std::string& pointed = "") {
    SCOPED_TRACE(code);
    Reading r;
    check(r, parts);
    EXPECT_EQ(r.count(code), 1u) << r.all();
    EXPECT_NE(r.pointed(code).find(pointed), std::string::npos) << r.all();
}

std::string surface(const std::string& binds) {
    return "<shader stage=\"SURFACE\"><name>s</name>" + binds + "</shader>";
}

}  // namespace

TEST(ProfileRsl, SaysNothingOfWhatIsRight) {
    Reading r;
    check(r, {});
    EXPECT_TRUE(r.diag.findings().empty()) << r.all();
}

TEST(ProfileRsl, ErrorsOfTheCodeStandInTheDocument) {
    Parts parts;
    parts.code = "surface s() { Ci = difuse(N); }";
    parts.params.clear();
    parts.pass = surface("");
    expect(parts, "RSL_UNKNOWN_FUNCTION", "difuse");
}

TEST(ProfileRsl, AStageNeedsItsShader) {
    Parts parts;
    parts.pass += "<shader stage=\"DISPLACEMENT\"><name>s</name></shader>";
    expect(parts, "RSL_SHADER_MISSING");
    parts.pass =
        "<shader stage=\"SURFACE\"><bind symbol=\"Kd\"><param ref=\"kd\"/></bind></shader>";
    parts.code += "surface second() { Ci = 1; }";
    expect(parts, "RSL_SHADER_AMBIGUOUS");
}

TEST(ProfileRsl, BindsFitTheirParameters) {
    Parts parts;
    std::string own = "<bind symbol=\"Kd\"><param ref=\"kd\"/></bind>";
    parts.pass = surface(own + "<bind symbol=\"tnit\"><color>1 0 0</color></bind>");
    expect(parts, "RSL_BIND_UNKNOWN", "tnit");
    parts.pass = surface(own + "<bind symbol=\"map\"><float>1</float></bind>");
    expect(parts, "RSL_BIND_TYPE", "map");
    parts.pass = surface(own + "<bind symbol=\"four\"><float>1</float></bind>");
    expect(parts, "RSL_BIND_TYPE", "four");
    parts.pass = surface(own + own);
    expect(parts, "RSL_BIND_TWICE", "Kd");
}

TEST(ProfileRsl, SetparamsFitTheParameterTheyReach) {
    Parts parts;
    parts.setparams = "<setparam ref=\"kd\"><color>1 0 0</color></setparam>";
    expect(parts, "RSL_SETPARAM_TYPE");
    parts.setparams = "<setparam ref=\"kd\"><float>1</float></setparam>";
    Reading r;
    check(r, parts);
    EXPECT_TRUE(r.diag.findings().empty()) << r.all();
}

TEST(ProfileRsl, WhatNothingUsesIsAHint) {
    Parts parts;
    parts.params += "<newparam sid=\"unused\"><float>1</float></newparam>";
    expect(parts, "RSL_PARAM_UNUSED", "unused");
    parts = {};
    parts.code += " displacement d() { P += 0.1 * N; }";
    expect(parts, "RSL_SHADER_UNUSED");
}

TEST(ProfileRsl, InstancesBindParametersThatExist) {
    Parts parts;
    parts.binds = "<bind semantic=\"nix\" target=\"e/kd\"/>";
    expect(parts, "RSL_SEMANTIC_UNKNOWN", "e/kd");
    parts.binds = "<bind_vertex_input semantic=\"nix\" input_semantic=\"TEXCOORD\"/>";
    expect(parts, "RSL_VERTEX_INPUT_UNKNOWN", "nix");
    parts.binds = "<bind semantic=\"Kd\" target=\"e/kd\"/>";
    Reading r;
    check(r, parts);
    EXPECT_TRUE(r.diag.findings().empty()) << r.all();
}

TEST(ProfileRsl, ImagersAreNoSurfaces) {
    Parts parts;
    parts.code += " imager i() { Ci = 1; }";
    parts.pass += "<shader stage=\"IMAGER\"><name>i</name></shader>";
    expect(parts, "RSL_STAGE_PLACE");
}

TEST(ProfileRsl, SpacesAreNodesOrStandard) {
    Parts parts;
    parts.params.clear();
    parts.pass = surface("");
    parts.code = "surface s() { Ci = color (transform(\"nowhere\", P)); Oi = 1; }";
    Reading r;
    check(r, parts);
    EXPECT_FALSE(r.diag.has_errors()) << r.all();
    EXPECT_NE(r.all().find("RSL_SPACE_UNKNOWN"), std::string::npos) << r.all();
    parts.code = "surface s() { Ci = color (transform(\"n\", P)); Oi = 1; }";
    Reading known;
    check(known, parts);
    EXPECT_EQ(known.all().find("RSL_SPACE_UNKNOWN"), std::string::npos) << known.all();
}

}  // namespace kinora
