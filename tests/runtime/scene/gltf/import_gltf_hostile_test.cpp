// tests/runtime/scene/gltf/import_gltf_hostile_test.cpp: glTF files that lie: findings with their
// locations, no crash, no memory beyond what a file's size allows.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "runtime/scene/build/build_scene.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/file/json_scan.h"
#include "runtime/scene/gltf/import/import.h"
#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

using nlohmann::json;

TEST(GltfHostile, TheWholeSceneIsSound) {
    auto r = rendering_of(whole_scene());
    r->scene->watch_dark = false;  // its spot light reaches nothing
    r->frame();
    // Its light misses the mesh, which is all there is to say.
    EXPECT_EQ(r->diagnostics.findings().size(), size_t(r->count("LIGHTS_DARK"))) << r->findings();
}

// One change of the sound scene, the code it must give and the JSON pointer it must name.
struct Lie {
    const char* name;
    std::function<void(json&)> tell;
    const char* code;
    const char* pointer;
};

json& at(json& j, const char* pointer) {
    return j[json::json_pointer(pointer)];
}

TEST(GltfHostile, EachLieHasItsFindingAndPlace) {
    const Lie kLies[] = {
        {"a mesh that is not there", [](json& j) { at(j, "/nodes/2/mesh") = 7; }, "GLTF_REFERENCE",
         "/nodes/2/mesh"},
        {"an accessor that is not there",
         [](json& j) { at(j, "/meshes/0/primitives/0/attributes/NORMAL") = 99; }, "GLTF_REFERENCE",
         "/meshes/0/primitives/0/attributes/NORMAL"},
        {"an accessor beyond its view", [](json& j) { at(j, "/accessors/0/count") = 5; },
         "GLTF_ACCESSOR", "/accessors/0"},
        {"a huge accessor", [](json& j) { at(j, "/accessors/0/count") = 4000000000u; },
         "GLTF_ACCESSOR", "/accessors/0"},
        {"a huge accessor of zeros",
         [](json& j) {
             at(j, "/accessors/0/count") = 4000000000u;
             at(j, "/accessors/0").erase("bufferView");
         },
         "GLTF_LIMIT", "/accessors/0"},
        {"an offset that wraps around",
         [](json& j) { at(j, "/accessors/0/byteOffset") = 18446744073709551600u; }, "GLTF_ACCESSOR",
         "/accessors/0"},
        {"a view beyond its buffer", [](json& j) { at(j, "/bufferViews/1/byteLength") = 1 << 30; },
         "GLTF_ACCESSOR", "/bufferViews/1"},
        {"a stride beyond its view", [](json& j) { at(j, "/bufferViews/1/byteStride") = 252; },
         "GLTF_ACCESSOR", "/accessors/0"},
        {"indices that are floats", [](json& j) { at(j, "/meshes/0/primitives/0/indices") = 0; },
         "GLTF_ACCESSOR", "/accessors/0"},
        {"positions of two numbers",
         [](json& j) { at(j, "/meshes/0/primitives/0/attributes/POSITION") = 2; }, "GLTF_PRIMITIVE",
         "/meshes/0/primitives/0/attributes/POSITION"},
        {"no positions",
         [](json& j) { at(j, "/meshes/0/primitives/0/attributes").erase("POSITION"); },
         "GLTF_PRIMITIVE", "/meshes/0/primitives/0"},
        {"a mode of none", [](json& j) { at(j, "/meshes/0/primitives/0/mode") = 9; },
         "GLTF_PRIMITIVE", "/meshes/0/primitives/0/mode"},
        {"a node below itself", [](json& j) { at(j, "/nodes/2/children") = {2}; }, "GLTF_NODE",
         "/nodes/2/children/0"},
        {"a node with two parents", [](json& j) { at(j, "/nodes/3/children") = {1}; }, "GLTF_NODE",
         "/nodes/3/children/0"},
        {"a scene that is not there", [](json& j) { j["scene"] = 3; }, "GLTF_REFERENCE", "/scene"},
        {"a material that is not there",
         [](json& j) { at(j, "/meshes/0/primitives/0/material") = 3; }, "GLTF_REFERENCE",
         "/meshes/0/primitives/0/material"},
        {"a texture that is not there",
         [](json& j) { at(j, "/materials/0/pbrMetallicRoughness/baseColorTexture/index") = 3; },
         "GLTF_REFERENCE", "/materials/0/pbrMetallicRoughness/baseColorTexture/index"},
        {"a rotation of three numbers",
         [](json& j) {
             at(j, "/nodes/1/rotation") = {1, 0, 0};
         },
         "GLTF_VALUE", "/nodes/1/rotation"},
        {"a joint that is not there", [](json& j) { at(j, "/skins/0/joints") = {44}; },
         "GLTF_REFERENCE", "/skins/0/joints/0"},
        {"an interpolation of none",
         [](json& j) { at(j, "/animations/0/samplers/0/interpolation") = "MAGIC"; },
         "GLTF_ANIMATION", "/animations/0/samplers/0/interpolation"},
        {"a channel of a node that is not there",
         [](json& j) { at(j, "/animations/0/channels/0/target/node") = 40; }, "GLTF_REFERENCE",
         "/animations/0/channels/0/target/node"},
        {"an extension of the future",
         [](json& j) { j["extensionsUsed"].push_back("EXT_tomorrow"); }, "GLTF_EXTENSION", nullptr},
    };
    for (const Lie& lie : kLies) {
        GltfText g = whole_scene();
        lie.tell(g.json);
        std::string text = g.gltf();
        auto d = described(text, ".gltf");
        EXPECT_TRUE(d->scene) << lie.name;
        const Finding* found = nullptr;
        for (const Finding& f : d->diagnostics.findings())
            if (f.info->code == std::string_view(lie.code) &&
                (!lie.pointer || f.id_path == lie.pointer))
                found = &f;
        ASSERT_TRUE(found) << lie.name << "\n" << d->findings();
        ASSERT_LT(found->where.begin, text.size());
        if (!lie.pointer) continue;
        // The position is that of the value (or of the nearest value around one that is not there).
        std::optional<JsonRange> range = json_nearest(text, lie.pointer);
        EXPECT_EQ(found->where.begin, range->begin) << lie.name;
    }
}

TEST(GltfHostile, WhatMakesNoSceneIsRefusedWithItsReason) {
    auto refused = [](const std::string& content, const char* extension, const char* code,
                      const char* word) {
        auto d = described(content, extension);
        EXPECT_FALSE(d->scene) << word;
        EXPECT_EQ(d->count(code), 1) << d->findings();
        EXPECT_NE(d->findings().find(word), std::string::npos) << d->findings();
    };
    refused("", ".glb", "GLTF_INVALID", "empty");
    refused("glTF\2", ".glb", "GLTF_INVALID", "header");
    std::string glb = whole_scene().glb();
    refused(glb.substr(0, glb.size() / 2), ".glb", "GLTF_INVALID", "says it has");
    refused("{\n \"asset\": {\"version\": \"2.0\",}\n}", ".gltf", "GLTF_INVALID", "gltf:2:");
    refused("{\"asset\": 1}", ".gltf", "GLTF_INVALID", "asset");
    refused(std::string(100000, '['), ".gltf", "GLTF_INVALID", "nested");
    std::string many = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}";
    for (int i = 0; i < 1100000; ++i) many += ",{}";
    refused(many + "]}", ".gltf", "GLTF_INVALID", "arrays and objects");
    GltfText draco = whole_scene();
    draco.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    refused(draco.glb(), ".glb", "GLTF_EXTENSION_REQUIRED", "KHR_draco_mesh_compression");
    json packed = whole_scene().json;  // as gltfpack writes it: a buffer that is made by unpacking
    packed["buffers"] = {
        {{"byteLength", 3}, {"uri", "data:application/octet-stream;base64,AAAA"}},
        {{"byteLength", 64}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    refused(packed.dump(), ".gltf", "GLTF_INVALID", "buffer 1 has no uri: EXT_meshopt_compression");
    packed["extensionsRequired"] = {"EXT_meshopt_compression"};
    refused(packed.dump(), ".gltf", "GLTF_EXTENSION_REQUIRED", "EXT_meshopt_compression");
    EXPECT_EQ(described(packed.dump(), ".gltf")->count("GLTF_INVALID"), 0);
    json apart = whole_scene().json;
    apart["buffers"] = {{{"byteLength", 100000}, {"uri", "gone%20away.bin"}}};
    refused(apart.dump(), ".gltf", "GLTF_BUFFER_FILE", "'gone away.bin' of buffer 0 is not there");
    const char* pointer =
        "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 335626\n";
    refused(pointer, ".glb", "GLTF_INVALID", "Git LFS pointer");
    refused(pointer, ".gltf", "GLTF_INVALID", "git lfs pull");
    refused("PK\3\4rest", ".glb", "GLTF_INVALID", "zip archive");
    refused("\x1f\x8brest", ".gltf", "GLTF_INVALID", "gzip");
    refused("{\"scenes\": {\"s\": {}}, \"nodes\": {}}", ".gltf", "GLTF_INVALID", "glTF 1.0");
    GltfText tomorrow = whole_scene();  // nobody knows what it changes
    tomorrow.json["extensionsRequired"] = {"EXT_tomorrow"};
    refused(tomorrow.glb(), ".glb", "GLTF_EXTENSION_REQUIRED", "EXT_tomorrow");
    GltfText image = whole_scene();
    image.json["bufferViews"][0]["byteOffset"] = 1u << 30;
    refused(image.glb(), ".glb", "GLTF_INVALID", "image 0");
    GltfText twice = whole_scene();
    std::string copies = twice.glb();
    json two = twice.json;
    two["buffers"] = {{{"byteLength", 4}}, {{"byteLength", 4}}};
    refused(two.dump(), ".gltf", "GLTF_INVALID", "no uri");
}

// KHR_draco_mesh_compression: the accessors of what is packed have no buffer view, those of what
// stands beside it for readers without the extension do.
TEST(GltfHostile, APackedPrimitiveIsNamedUnlessItsNumbersStandBesideIt) {
    GltfText g;
    g.node({{"mesh", g.square()}});
    g.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    json& primitive = g.json["meshes"][0]["primitives"][0];
    primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
    auto beside = described(g.glb());
    ASSERT_TRUE(beside->scene) << beside->findings();
    EXPECT_EQ(beside->scene->meshes.at(0).groups.size(), 1u);
    EXPECT_EQ(beside->count("GLTF_PRIMITIVE"), 0) << beside->findings();
    for (const auto& [name, accessor] : primitive["attributes"].items())
        g.json["accessors"][size_t(accessor)].erase("bufferView");
    auto packed = described(g.glb());
    ASSERT_TRUE(packed->scene) << packed->findings();
    EXPECT_TRUE(packed->scene->meshes.at(0).groups.empty());
    EXPECT_EQ(packed->count("GLTF_PRIMITIVE"), 1) << packed->findings();
    EXPECT_NE(packed->findings().find("KHR_draco_mesh_compression packs it"), std::string::npos);
}

TEST(GltfHostile, ABufferThatIsAPointerIsNamed) {
    GltfText g;
    g.node({{"mesh", g.square()}});
    GltfFileOnDisk pointer(
        "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 335626\n", ".bin");
    json whole = g.json;
    std::string name = std::filesystem::path(pointer.path()).filename().string();
    whole["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", name}}};
    auto d = described(whole.dump(), ".gltf");
    EXPECT_FALSE(d->scene);
    EXPECT_NE(d->findings().find("Git LFS pointer"), std::string::npos) << d->findings();
}

TEST(GltfHostile, RequiredExtensionsThatChangeNothingAreRead) {
    GltfText variants = whole_scene();
    variants.json["extensionsUsed"].push_back("KHR_materials_variants");
    variants.json["extensionsRequired"] = {"KHR_materials_variants", "KHR_xmp_json_ld"};
    auto d = described(variants.glb());
    ASSERT_TRUE(d->scene) << d->findings();
    EXPECT_EQ(d->count("GLTF_EXTENSION"), 2) << d->findings();
    EXPECT_EQ(d->count("GLTF_EXTENSION_SHOWN"), 0) << d->findings();
}

TEST(GltfHostile, RequiredExtensionsAreIgnoredWhereThatIsAskedFor) {
    GltfText g = whole_scene();
    g.json["extensionsRequired"] = {"EXT_tomorrow"};
    GltfFileOnDisk file(g.glb());
    ImportOptions options;
    options.ignore_required = true;
    Diagnostics diagnostics;
    EXPECT_TRUE(import_gltf(file.path(), options, diagnostics));
    ASSERT_EQ(diagnostics.findings().size(), 1u);
    EXPECT_EQ(diagnostics.findings()[0].info, &Code::GLTF_EXTENSION_SHOWN);
}

TEST(GltfHostile, FilesOutsideTheFolderAreNotRead) {
    namespace fs = std::filesystem;
    fs::path root = fs::temp_directory_path() / ("kinora_gltf_outside_" + std::to_string(getpid()));
    fs::create_directories(root / "scene");
    GltfText g;
    g.node({{"mesh", g.square()}});
    std::ofstream(root / "data.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(g.bytes.data()), std::streamsize(g.bytes.size()));
    fs::copy_file(root / "data.bin", root / "scene" / "own data.bin");
    auto read = [&](const std::string& uri, bool allow) {
        json whole = g.json;
        whole["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", uri}}};
        std::string path = (root / "scene" / "s.gltf").string();
        std::ofstream(path) << whole.dump();
        ImportOptions options;
        if (allow) options.allow_external.push_back(root.string());
        Diagnostics diagnostics;
        return import_gltf(path, options, diagnostics).has_value();
    };
    EXPECT_TRUE(read("own%20data.bin", false));
    EXPECT_FALSE(read("../data.bin", false));
    EXPECT_TRUE(read("../data.bin", true));
    EXPECT_FALSE(read((root / "data.bin").string(), false));
    fs::create_symlink(root / "data.bin", root / "scene" / "link.bin");
    EXPECT_FALSE(read("link.bin", false));
    EXPECT_FALSE(read("/etc/passwd", false));
    fs::remove_all(root);
}

TEST(GltfHostile, NumbersThatAreNotFiniteLeaveTheirTrianglesOut) {
    float bad = std::numeric_limits<float>::quiet_NaN();
    GltfText g;
    g.node({{"mesh", g.mesh({{"POSITION", g.floats({0, 0, 0, 1, 0, 0, bad, 1, 0,  //
                                                    0, 0, 0, 1, 0, 0, 1, 1, 0},
                                                   "VEC3")}})}});
    auto r = rendering_of(g);
    r->frame();
    EXPECT_EQ(r->count("GLTF_TRIANGLES"), 1) << r->findings();
    EXPECT_EQ(r->scene->meshes[0].groups[0].triangles.size(), 3u);
}

TEST(GltfHostile, IndicesBeyondTheVerticesLeaveTheirTrianglesOut) {
    GltfText g;
    g.node({{"mesh", g.mesh({{"POSITION", g.floats({0, 0, 0, 1, 0, 0, 1, 1, 0}, "VEC3")}},
                            g.shorts({0, 1, 2, 0, 1, 65535}))}});
    auto d = described(g.glb());
    EXPECT_EQ(d->count("GLTF_TRIANGLES"), 1);
    EXPECT_EQ(d->scene->meshes[0].groups[0].triangles.size(), 3u);
}

TEST(GltfHostile, ManyFindingsAreCounted) {
    GltfText g;
    for (int i = 0; i < 500; ++i) g.node({{"mesh", i}});
    auto d = described(g.glb());
    EXPECT_EQ(d->diagnostics.findings().size(), 101u);
    EXPECT_EQ(d->count("GLTF_MORE"), 1);
}

// ---- mutations: bytes and values changed at random; nothing may crash or hang

json mutated(json j, std::mt19937& random) {
    json flat = j.flatten();
    auto it = flat.begin();
    std::advance(it, int(random() % flat.size()));
    const json kValues[] = {-1,
                            0,
                            1,
                            3,
                            255,
                            65536,
                            4294967295u,
                            1e300,
                            -1e-300,
                            "",
                            "VEC3",
                            "\xc3\xa9",
                            true,
                            nullptr,
                            json::array(),
                            json::object(),
                            9007199254740993};
    *it = kValues[random() % std::size(kValues)];
    try {
        return flat.unflatten();
    } catch (const json::exception&) {
        return j;
    }
}

int rounds() {
    const char* wanted = std::getenv("KINORA_FUZZ_GLTF");
    return wanted ? std::atoi(wanted) : 150;
}

TEST(GltfHostile, ChangedValuesNeverCrash) {
    std::mt19937 random(7);
    GltfText g = whole_scene();
    for (int i = 0; i < rounds(); ++i) {
        GltfText changed = g;
        for (uint32_t n = 0; n <= random() % 3; ++n) changed.json = mutated(changed.json, random);
        SCOPED_TRACE(changed.json.dump());
        survive(changed.glb(), ".glb");
    }
}

TEST(GltfHostile, ChangedBytesNeverCrash) {
    std::mt19937 random(8);
    std::string glb = whole_scene().glb();
    for (int i = 0; i < rounds(); ++i) {
        std::string changed = glb;
        for (uint32_t n = 0; n <= random() % 8; ++n)
            changed[random() % changed.size()] = char(random() % 4 ? random() : '9');
        if (random() % 4 == 0) changed.resize(random() % changed.size());
        survive(changed, ".glb");
    }
}

// ---- positions in JSON

TEST(JsonText, PointersFindTheirValues) {
    std::string text = R"({ "a" : [1, {"b/c": "x\"}]", "é": [[], 5e3]}], "d": true })";
    auto value = [&](const char* pointer) -> std::string {
        auto range = json_find(text, pointer);
        return range ? text.substr(range->begin, range->end - range->begin) : "none";
    };
    EXPECT_EQ(value("/a/0"), "1");
    EXPECT_EQ(value("/a/1/b~1c"), R"("x\"}]")");
    EXPECT_EQ(value("/a/1/é/1"), "5e3");
    EXPECT_EQ(value("/d"), "true");
    EXPECT_EQ(value("/a/2"), "none");
    EXPECT_EQ(value("/e"), "none");
    EXPECT_EQ(json_nearest(text, "/a/7/x")->begin, text.find('['));
    EXPECT_EQ(json_elements(text, "/a").size(), 2u);
    EXPECT_EQ(json_number(text, "/a/1/é/1", 0), 5000);
}

TEST(JsonText, StringsKnowWhereEachOfTheirBytesStands) {
    std::string text = R"(["ab\nc\u00e9d\ud83d\ude00e"])";
    SourceMap map;
    std::string got = json_string(text, *json_find(text, "/0"), 3, map);
    EXPECT_EQ(got,
              "ab\nc\xc3\xa9"
              "d\xf0\x9f\x98\x80"
              "e");
    EXPECT_EQ(map.file, 3u);
    EXPECT_EQ(map.file_offset(0), 2u);
    EXPECT_EQ(map.file_offset(3), text.find("c\\u"));
    EXPECT_EQ(map.file_offset(6), text.find("d\\u"));
    EXPECT_EQ(map.file_offset(11), text.find("e\"]"));
}

}  // namespace
}  // namespace kinora
