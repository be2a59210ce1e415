// tests/collada/effects_test.cpp: profile_RSL, profile_COMMON, lights, cameras and images.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

TEST(Rsl, ReadsAppendixAWithPlacesOfTheCode) {
    Reading r;
    read_file(r, test_file("matte.dae"));
    ASSERT_TRUE(r.scene && r.scene->effects.size() == 1) << r.all();
    const Effect& effect = r.scene->effects[0];
    ASSERT_TRUE(effect.rsl);
    ASSERT_EQ(effect.rsl->codes.size(), 1u);
    const RslCode& code = effect.rsl->codes[0];
    uint32_t at = uint32_t(code.text.find("Ci"));
    LineColumn place = r.diag.files.line_column(code.map.file, code.map.file_offset(at));
    EXPECT_EQ(place.line, 13);
    EXPECT_EQ(place.column, 5);
    const RslShader& shader = effect.rsl->shaders.at(0);
    EXPECT_EQ(shader.stage, RslStage::Surface);
    EXPECT_EQ(shader.name, "matte");
    ASSERT_EQ(shader.binds.size(), 3u);
    EXPECT_EQ(effect.params.at(shader.binds[0].param).sid, "ambient");
    EXPECT_EQ(effect.params.at(shader.binds[1].param).value.numbers,
              (std::vector<double>{0.5, 0.5, 0.5}));  // one number is grey
    EXPECT_EQ(shader.binds[2].param, kNone);
    EXPECT_EQ(shader.binds[2].literal.array_length, 3u);
    ASSERT_EQ(r.scene->materials.size(), 2u);
    const SetParam& set = r.scene->materials[1].setparams.at(0);
    EXPECT_EQ(set.value.numbers, (std::vector<double>{1, 0, 0}));
    EXPECT_EQ(effect.params.at(set.param).sid, "tint");
    EXPECT_EQ(r.count("FX_COLOR_ALPHA"), 1u);
    const ParamBinding& bind = r.node("a").meshes.at(0).materials.at(0).params.at(0);
    EXPECT_EQ(bind.ref.kind, Owner::Transform);
    EXPECT_EQ(bind.ref.count, 1u);
}

std::string rsl_document(const std::string& technique) {
    return with_scene(
        "<library_effects><effect id=\"fx\"><newparam sid=\"roughness\"><float>0.1</float>"
        "</newparam><profile_RSL><technique sid=\"t\">\n" +
            technique +
            "</technique></profile_RSL></effect></library_effects><library_materials><material "
            "id=\"m\"><instance_effect url=\"#fx\"/></material></library_materials>"
            "<library_lights><light id=\"l\"><technique_common><point/></technique_common><extra>"
            "<technique profile=\"RSL\"><instance_effect url=\"#fx\"/><shadows>0</shadows>"
            "</technique></extra></light></library_lights>",
        "<node id=\"n\"><instance_light url=\"#l\"/></node>");
}

const std::string kShader = "<pass><shader stage=\"LIGHT\"><name>l</name></shader></pass>";

TEST(Rsl, ShadesLightsThroughTheirExtra) {
    Reading r;
    read_text(r, rsl_document("<code>light l() {}</code>" + kShader));
    ASSERT_TRUE(r.scene && r.scene->lights.size() == 1) << r.all();
    const Light& light = r.scene->lights[0];
    ASSERT_NE(light.rsl_material, kNone);
    EXPECT_TRUE(r.scene->effects.at(r.scene->materials.at(light.rsl_material).effect).rsl);
    EXPECT_EQ(light.shadows, false);
}

TEST(Rsl, FaultsAreNamedWithTheirPlace) {
    struct {
        std::string technique, code, pointed;
    } cases[] = {
        {kShader, "RSL_NO_CODE", "<technique sid=\"t\">"},
        {"<code>x</code>", "RSL_NO_SHADER", "<technique sid=\"t\">"},
        {"<code>x</code><pass><shader stage=\"PIXEL\"/></pass>", "RSL_STAGE", "PIXEL"},
        {"<include url=\"nowhere.sl\"/>" + kShader, "RSL_INCLUDE_MISSING", "nowhere.sl"},
        {"<include url=\"x.slo\"/>" + kShader, "RSL_INCLUDE_COMPILED", "x.slo"},
        {"<include url=\"../../../../../../etc/passwd\"/>" + kShader, "LINK_OUTSIDE",
         "../../../../../../etc/passwd"},
        {"<code>x</code><pass><shader stage=\"LIGHT\"><bind symbol=\"Ks\"><param "
         "ref=\"roughnes\"/></bind></shader></pass>",
         "FX_PARAM_UNRESOLVED", "roughnes"},
        {"<code>x</code><pass><shader stage=\"LIGHT\"><bind symbol=\"Ks\"/></shader></pass>",
         "RSL_BIND_EMPTY", "<bind symbol=\"Ks\"/>"},
    };
    for (const auto& c : cases) {
        Reading r;
        read_text(r, rsl_document(c.technique));
        EXPECT_EQ(r.count(c.code), 1u) << c.technique << r.all();
        EXPECT_EQ(r.pointed(c.code), c.pointed);
    }
    Reading near;
    read_text(near, rsl_document(cases[6].technique));
    EXPECT_NE(near.all().find("did you mean 'roughness'?"), std::string::npos);
}

TEST(Rsl, IncludesAreReadBesideTheDocument) {
    std::string folder = testing::TempDir() + "kinora_collada_include";
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/my shader.sl") << "light l()\n{}\n";
    Reading r;
    read_text(r, rsl_document("<include url=\"my%20shader.sl\"/>" + kShader), folder + "/s.dae");
    ASSERT_TRUE(r.scene && r.scene->effects.at(0).rsl) << r.all();
    const RslCode& code = r.scene->effects[0].rsl->codes.at(0);
    EXPECT_EQ(code.text, "light l()\n{}\n");
    EXPECT_EQ(r.diag.files.line_column(code.map.file, code.map.file_offset(10)).line, 2);
    std::ofstream(folder + "/binary.sl", std::ios::binary) << std::string("\x7f\0\0ELF", 6);
    Reading binary;
    read_text(binary, rsl_document("<include url=\"binary.sl\"/>" + kShader), folder + "/s.dae");
    EXPECT_EQ(binary.count("RSL_INCLUDE_COMPILED"), 1u);
}

TEST(Common, ReadsSlotsSamplersAndExtras) {
    Reading r;
    read_file(r, test_file("common.dae"));
    ASSERT_TRUE(r.scene && r.scene->effects.size() == 1) << r.all();
    const Effect& effect = r.scene->effects[0];
    ASSERT_TRUE(effect.common);
    const CommonShading& c = *effect.common;
    EXPECT_EQ(c.model, CommonModel::Phong);
    EXPECT_EQ(c.technique_sid, "common");
    EXPECT_EQ(c.opaque, Opaque::RgbZero);
    EXPECT_FALSE(c.double_sided);
    EXPECT_EQ(c[CommonSlot::Specular].slot.values[2], 0.3);
    EXPECT_EQ(c[CommonSlot::Specular].slot.values[3], 1);
    EXPECT_EQ(c[CommonSlot::Reflective].source, SlotSource::Absent);
    ASSERT_EQ(c[CommonSlot::Shininess].source, SlotSource::Param);
    EXPECT_EQ(effect.params.at(c[CommonSlot::Shininess].param).value.numbers[0], 12);
    ASSERT_EQ(c[CommonSlot::Diffuse].source, SlotSource::Texture);
    EXPECT_EQ(c[CommonSlot::Diffuse].texcoord, "UV0");
    const TextureSampler& s = effect.samplers.at(c[CommonSlot::Diffuse].sampler);
    EXPECT_EQ(s.wrap_s, Wrap::Mirror);
    EXPECT_EQ(s.wrap_t, Wrap::Wrap);
    EXPECT_EQ(s.min, Filter::Nearest);
    EXPECT_EQ(s.mip, Filter::Linear);
    EXPECT_EQ(r.scene->images.at(s.image).path, "");
    EXPECT_EQ(r.count("FILE_MISSING"), 1u);
}

TEST(Common, ColorsAndTextures15AndDirectImages) {
    auto document = [](const std::string& newparams, const std::string& diffuse) {
        return with_mesh(
            "0 0 0 1 0 0 1 1 0", 3,
            "<triangles count=\"1\" material=\"m\"><input semantic=\"VERTEX\" "
            "source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
            "</library_geometries><library_images><image id=\"i\"><init_from><ref>a.png"
            "</ref></init_from></image></library_images><library_effects><effect "
            "id=\"fx\"><profile_COMMON>" +
                newparams + "<technique sid=\"c\"><lambert><diffuse>" + diffuse +
                "</diffuse></lambert></technique></profile_COMMON></effect>"
                "</library_effects><library_materials><material id=\"mat\">"
                "<instance_effect url=\"#fx\"/></material></library_materials>"
                "<library_geometries><geometry id=\"h\"><mesh>");
    };
    auto bound = [](std::string text) {
        std::string from = "<instance_geometry url=\"#g\"/>";
        return text.replace(text.find(from), from.size(),
                            "<instance_geometry url=\"#g\"><bind_material><technique_common>"
                            "<instance_material symbol=\"m\" target=\"#mat\"/></technique_common>"
                            "</bind_material></instance_geometry>");
    };
    Reading v15;
    read_text(v15, bound(document("<newparam sid=\"s\"><sampler2D><instance_image url=\"#i\"/>"
                                  "</sampler2D></newparam>",
                                  "<texture texture=\"s\" texcoord=\"T\"/>")));
    ASSERT_EQ(v15.scene->effects.size(), 1u) << v15.all();
    EXPECT_EQ(v15.scene->effects[0].samplers.at(0).image, 0u);
    Reading direct;
    read_text(direct, bound(document("", "<texture texture=\"i\" texcoord=\"T\"/>")));
    EXPECT_EQ(direct.pointed("TEX_DIRECT_IMAGE"), "i");
    Reading lost;
    read_text(lost, bound(document("", "<texture texture=\"zzz\" texcoord=\"T\"/>")));
    EXPECT_EQ(lost.pointed("TEX_UNRESOLVED"), "zzz");
    EXPECT_TRUE(lost.scene->effects.at(0).samplers.empty());
    EXPECT_EQ(lost.count("FX_NO_COLOR"), 1u);
}

// Two materials on one mesh: what is inside their <lambert>s.
std::string with_lamberts(const std::string& first, const std::string& second,
                          const std::string& light = "<point/>") {
    auto effect = [](const std::string& id, const std::string& lambert) {
        return "<effect id=\"" + id + "-fx\"><profile_COMMON><technique sid=\"c\"><lambert>" +
               lambert + "</lambert></technique></profile_COMMON></effect>";
    };
    auto material = [](const std::string& id) {
        return "<material id=\"" + id + "\"><instance_effect url=\"#" + id + "-fx\"/></material>";
    };
    auto bound = [](const std::string& id) {
        return "<instance_material symbol=\"" + id + "\" target=\"#" + id + "\"/>";
    };
    return with_scene(
        "<library_images><image id=\"1\" name=\"wall\"><init_from>maps/Wall.png"
        "</init_from></image></library_images><library_effects>" +
            effect("a", first) + effect("b", second) + "</library_effects><library_materials>" +
            material("a") + material("b") +
            "</library_materials><library_lights><light id=\"l\"><technique_common>" + light +
            "</technique_common></light></library_lights><library_geometries>" +
            triangle_geometry("g", {"a", "b"}) + "</library_geometries>",
        "<node id=\"n\"><instance_geometry url=\"#g\"><bind_material>"
        "<technique_common>" +
            bound("a") + bound("b") +
            "</technique_common></bind_material></instance_geometry><instance_light "
            "url=\"#l\"/></node>");
}

std::string colored(const std::string& slot, const std::string& color) {
    return "<" + slot + "><color>" + color + " 1</color></" + slot + ">";
}

double red_of(const Reading& r, size_t effect) {
    return r.scene->effects.at(effect).common->slots[size_t(CommonSlot::Diffuse)].slot.values[0];
}

TEST(Common, AColorInAmbientAloneIsTheDiffuseOne) {
    const std::string kRed = colored("ambient", "0.7 0.1 0.1"), kNo = colored("diffuse", "0 0 0");
    Reading missing;
    read_text(missing, with_lamberts(kRed, colored("diffuse", "0 1 0")));
    ASSERT_TRUE(missing.scene) << missing.all();
    EXPECT_EQ(red_of(missing, 0), 0.7);
    EXPECT_EQ(missing.count("FX_AMBIENT_ONLY"), 1u);
    Reading black;
    read_text(black, with_lamberts(kRed + kNo, colored("ambient", "0.2 0 0") + kNo));
    EXPECT_EQ(red_of(black, 0), 0.7);
    EXPECT_EQ(red_of(black, 1), 0.2);
    EXPECT_EQ(black.count("FX_AMBIENT_ONLY"), 2u);
}

TEST(Common, BlackThatMayBeMeantStaysBlack) {
    const std::string kRed = colored("ambient", "0.7 0.1 0.1"), kNo = colored("diffuse", "0 0 0");
    const std::string kTexture = "<diffuse><texture texture=\"1\" texcoord=\"T\"/></diffuse>";
    for (const std::string& other :
         {colored("diffuse", "0 1 0"), kTexture, colored("emission", "1 1 1"),
          colored("reflective", "1 1 1") + "<reflectivity><float>1</float></reflectivity>"}) {
        Reading r;
        read_text(r, with_lamberts(kRed + kNo, other));
        ASSERT_TRUE(r.scene) << r.all();
        EXPECT_EQ(red_of(r, 0), 0) << other;
        EXPECT_EQ(r.count("FX_AMBIENT_ONLY"), 0u);
    }
    Reading lit;
    read_text(lit,
              with_lamberts(kRed + kNo, kRed + kNo, "<ambient><color>1 1 1</color></ambient>"));
    EXPECT_EQ(red_of(lit, 0), 0) << "ambient light shows it";
}

// 0.8 in linear light, which sRGB writes as 1.055 * 0.8 ^ (1 / 2.4) - 0.055 (IEC 61966-2-1).
TEST(Common, AModelWithoutAnyColorIsGrey) {
    Reading r;
    read_text(
        r, with_lamberts("<shininess><float>3</float></shininess>", colored("emission", "0 0 0")));
    ASSERT_TRUE(r.scene) << r.all();
    EXPECT_NEAR(red_of(r, 0), 1.055 * std::pow(0.8, 1 / 2.4) - 0.055, 1e-4);
    EXPECT_EQ(red_of(r, 1), 0) << "black is written";
    EXPECT_EQ(r.count("FX_NO_COLOR"), 1u);
}

TEST(Common, AConstantShowsItsDiffuseColorWhereItHasNoOther) {
    auto emission = [](const std::string& slots) {
        std::string text = with_lamberts(slots, colored("diffuse", "0 1 0"));
        for (const char* tag : {"<lambert>", "</lambert>"})
            text.replace(text.find(tag), std::string(tag).size(),
                         tag[1] == '/' ? "</constant>" : "<constant>");
        Reading r;
        read_text(r, text);
        EXPECT_EQ(r.count("FX_AMBIENT_ONLY"), 0u);
        const CommonShading& common = *r.scene->effects.at(0).common;
        return common[CommonSlot::Emission].slot.values[0];
    };
    EXPECT_EQ(emission(colored("diffuse", "0.7 0 0")), 0.7);
    EXPECT_EQ(emission(colored("emission", "0 0 0") + colored("diffuse", "0.7 0 0")), 0.7);
    EXPECT_EQ(emission(colored("emission", "0.1 0 0") + colored("diffuse", "0.7 0 0")), 0.1);
}

TEST(Common, ATextureMayNameAnImageByOtherNamesOrAFile) {
    auto texture = [](const std::string& name) {
        return "<diffuse><texture texture=\"" + name + "\" texcoord=\"T\"/></diffuse>";
    };
    std::string folder = testing::TempDir() + "kinora_direct_texture/";
    std::filesystem::create_directories(folder + "maps");
    std::ofstream(folder + "maps/Wall.png") << "x";
    std::ofstream(folder + "bricks.png") << "x";
    auto path_of = [&](const std::string& name, const char* code) {
        Reading r;
        read_text(r, with_lamberts(texture(name), ""), folder + "scene.dae");
        EXPECT_EQ(r.count(code), 1u) << r.all();
        EXPECT_EQ(r.pointed(code), name);
        if (r.scene->effects.at(0).samplers.empty()) return std::string("none");
        return r.scene->images.at(r.scene->effects[0].samplers[0].image).path;
    };
    for (const char* name : {"1", "#1", "wall", "Wall.png", "C:\\art\\Wall.png"})
        EXPECT_EQ(path_of(name, "TEX_DIRECT_IMAGE"), folder + "maps/Wall.png");
    EXPECT_EQ(path_of("bricks.png", "TEX_DIRECT_FILE"), folder + "bricks.png");
    EXPECT_EQ(path_of("./bricks.png", "TEX_DIRECT_FILE"), folder + "bricks.png");
    EXPECT_EQ(path_of("tiles.png", "TEX_UNRESOLVED"), "none");
    EXPECT_EQ(path_of("bricks", "TEX_UNRESOLVED"), "none");
}

TEST(Images, AreFoundWhereExportersMeant) {
    std::string folder = testing::TempDir() + "kinora_collada_images/";
    std::filesystem::create_directories(folder + "tex");
    std::ofstream(folder + "Wood.PNG") << "x";
    std::ofstream(folder + "tex/stone wall.jpg") << "x";
    struct {
        std::string uri, found;
    } cases[] = {{"Wood.PNG", "Wood.PNG"},
                 {"./wood.png", "Wood.PNG"},
                 {"wood.tga", "Wood.PNG"},
                 {"file:///C:/Users/me/Wood.tga", "Wood.PNG"},
                 {"C:\\art\\wood.png", "Wood.PNG"},
                 {"file://Wood.PNG", "Wood.PNG"},
                 {"file://localhost" + folder + "Wood.PNG", "Wood.PNG"},
                 {"file://localhost/no/such/stone wall.jpg", ""},
                 {"tex\\stone%20wall.jpg", "tex/stone wall.jpg"},
                 {"tex/stone wall.tga", "tex/stone wall.jpg"},
                 {"<![CDATA[\n  Wood.PNG  \n]]>", "Wood.PNG"},
                 {"/etc/passwd", "/etc/passwd"},  // who shows it finds that it is no picture
                 {"/no/such/wall.png", ""},
                 {"nothing.png", ""}};
    for (const auto& c : cases) {
        Reading r;
        read_text(
            r,
            with_scene("<library_images><image id=\"i\"><init_from>" + c.uri +
                           "</init_from></image></library_images><library_effects><effect "
                           "id=\"fx\"><newparam sid=\"map\"><string>i</string></newparam>"
                           "<profile_RSL><technique sid=\"t\"><code>x</code>" +
                           kShader +
                           "</technique></profile_RSL></effect></library_effects>"
                           "<library_lights><light id=\"l\"><extra><technique "
                           "profile=\"RSL\"><instance_effect url=\"#fx\"/></technique></extra>"
                           "</light></library_lights>",
                       "<node><instance_light url=\"#l\"/></node>"),
            folder + "s.dae");
        ASSERT_EQ(r.scene->images.size(), 1u) << r.all();
        bool beside = !c.found.empty() && c.found[0] != '/';
        EXPECT_EQ(r.scene->images[0].path, beside ? folder + c.found : c.found) << c.uri;
        EXPECT_EQ(r.scene->effects.at(0).params.at(0).value.image, 0u);
    }
}

TEST(CamerasAndLights, ReadTheirTermsAndDefaults) {
    Reading r;
    read_file(r, test_file("common.dae"));
    const Camera& camera = r.scene->cameras.at(0);
    EXPECT_EQ(camera[CameraSlot::Xfov].values[0], 40);
    EXPECT_EQ(camera[CameraSlot::Xfov].sid, "fov");
    EXPECT_FALSE(camera[CameraSlot::Yfov].present());
    EXPECT_EQ(camera[CameraSlot::AspectRatio].values[0], 1.5);
    const Light& light = r.scene->lights.at(0);
    EXPECT_EQ(light.kind, LightKind::Spot);
    EXPECT_EQ(light[LightSlot::Color].values[2], 0.25);
    EXPECT_EQ(light[LightSlot::FalloffAngle].values[0], 45);
    EXPECT_EQ(light[LightSlot::ConstantAttenuation].values[0], 1);
    EXPECT_EQ(light[LightSlot::LinearAttenuation].values[0], 0);
    EXPECT_FALSE(light.shadows);
}

TEST(CamerasAndLights, ImpossibleValuesAreReplaced) {
    Reading r;
    read_text(r,
              with_scene("<library_cameras><camera id=\"c\"><optics><technique_common>"
                         "<perspective><yfov>180</yfov><znear>5</znear><zfar>5</zfar>"
                         "</perspective></technique_common></optics></camera></library_cameras>"
                         "<library_lights><light id=\"l\"><technique_common><spot><color>1 1 1"
                         "</color><falloff_angle>-3</falloff_angle></spot></technique_common>"
                         "</light></library_lights>",
                         "<node><instance_camera url=\"#c\"/><instance_light url=\"#l\"/></node>"));
    ASSERT_TRUE(r.scene);
    EXPECT_FALSE(r.scene->cameras.at(0)[CameraSlot::Yfov].present());
    EXPECT_FALSE(r.scene->cameras[0][CameraSlot::Znear].present());
    EXPECT_EQ(r.count("CAM_FOV"), 1u);
    EXPECT_EQ(r.count("CAM_Z"), 1u);
    EXPECT_EQ(r.scene->lights.at(0)[LightSlot::FalloffAngle].values[0], 180);
    EXPECT_EQ(r.count("LIGHT_RANGE"), 1u);
}

}  // namespace
}  // namespace kinora::collada
