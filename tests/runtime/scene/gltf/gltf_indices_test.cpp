// tests/runtime/scene/gltf/gltf_indices_test.cpp: indices that name nothing, one by one, in files
// with all kinds of them. KINORA_FUZZ_INDICES=N sets how many of each kind a file has changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "runtime/scene/gltf/document/glb.h"
#include "runtime/scene/gltf/export/export.h"
#include "runtime/scene/gltf/file/indices.h"
#include "runtime/scene/load/import_scene.h"
#include "tests/folders.h"
#include "tests/fuzz_settings.h"
#include "tests/runtime/scene/gltf/gltf_text.h"

namespace kinora {
namespace {

using nlohmann::json;

// The properties of type glTFid in Khronos' JSON schema of glTF 2.0, and KHR_lights_punctual's.
bool is_index(const std::string& pointer) {
    static const std::regex ids(
        "/scene|/scenes/\\d+/nodes/\\d+|/nodes/\\d+/(camera|mesh|skin|children/\\d+)|"
        "/nodes/\\d+/extensions/KHR_lights_punctual/light|"
        "/meshes/\\d+/primitives/\\d+/(indices|material|attributes/[^/]+|targets/\\d+/[^/]+)|"
        "/materials/.*Texture/index|/textures/\\d+/(sampler|source)|/images/\\d+/bufferView|"
        "/skins/\\d+/(inverseBindMatrices|skeleton|joints/\\d+)|"
        "/animations/\\d+/(channels/\\d+/(sampler|target/node)|samplers/\\d+/(input|output))|"
        "/accessors/\\d+/(bufferView|sparse/(indices|values)/bufferView)|/bufferViews/\\d+/buffer");
    return std::regex_match(pointer, ids);
}

std::vector<std::string> number_pointers(const json& whole) {
    std::vector<std::string> pointers;
    const json flat = whole.flatten();
    for (const auto& [pointer, value] : flat.items())
        if (value.is_number_integer()) pointers.push_back(pointer);
    return pointers;
}

void array_pointers(const json& value, const std::string& pointer, std::vector<std::string>& to) {
    if (value.is_array()) to.push_back(pointer);
    if (!value.is_structured()) return;
    for (const auto& [key, inside] : value.items()) {
        std::string token = std::regex_replace(key, std::regex("/"), "~1");
        array_pointers(inside, pointer + "/" + token, to);
    }
}

// At most so many of each kind: those that differ in numbers alone are of one.
std::vector<std::string> some_of_each_kind(const std::vector<std::string>& pointers, size_t most) {
    static const std::regex number("/\\d+");
    std::map<std::string, size_t> seen;
    std::vector<std::string> some;
    for (const std::string& pointer : pointers)
        if (seen[std::regex_replace(pointer, number, "/*")]++ < most) some.push_back(pointer);
    return some;
}

constexpr int64_t kNothing[] = {-1, 2147483647, 2147483648, 4294967295, 4294967296};

TEST(GltfIndices, OneThatNamesNothingIsAFindingWithItsNumberAsWritten) {
    const json sound = json::parse(whole_scene().gltf());
    ASSERT_TRUE(check_gltf_indices(sound.dump()).faults.empty());
    size_t indices = 0;
    for (const std::string& pointer : number_pointers(sound)) {
        for (int64_t number : kNothing) {
            json changed = sound;
            changed[json::json_pointer(pointer)] = number;
            const std::string text = changed.dump();
            const GltfIndices found = check_gltf_indices(text);
            ASSERT_EQ(found.faults.size(), is_index(pointer) ? 1u : 0u) << pointer;
            if (found.faults.empty()) continue;
            ++indices;
            const GltfIndexFault& fault = found.faults[0];
            EXPECT_EQ(fault.pointer, pointer);
            EXPECT_EQ(fault.value, std::to_string(number));
            EXPECT_EQ(text.substr(fault.range.begin, fault.range.end - fault.range.begin),
                      fault.value);
            json mended = sound;  // nothing else changes
            mended[json::json_pointer(pointer)] = 2147483647;
            EXPECT_EQ(json::parse(found.mended), mended) << pointer;
        }
    }
    EXPECT_GT(indices, 5 * 30u);
}

TEST(GltfIndices, TheListsSizeIsTheFirstThatNamesNothing) {
    const json sound = json::parse(whole_scene().gltf());
    const size_t nodes = sound["nodes"].size();
    auto faults = [&](const char* pointer, size_t number) {
        json changed = sound;
        changed[json::json_pointer(pointer)] = number;
        return check_gltf_indices(changed.dump()).fault_count;
    };
    EXPECT_EQ(faults("/scenes/0/nodes/0", nodes - 1), 0u);
    EXPECT_EQ(faults("/scenes/0/nodes/0", nodes), 1u);
    // Samplers are those of the same animation.
    EXPECT_EQ(faults("/animations/0/channels/0/sampler", 1), 0u);
    EXPECT_EQ(faults("/animations/0/channels/0/sampler", 2), 1u);
}

TEST(GltfIndices, AValueOfAnotherTypeNamesNothing) {
    for (const char* value : {"\"0\"", "1.5", "true", "null", "{}", "[0]", "-0", "0.0", "1e0"}) {
        const std::string text =
            std::string(R"({"nodes":[{"mesh":)") + value + R"(},{"mesh":0}],"meshes":[{},{}]})";
        const GltfIndices found = check_gltf_indices(text);
        ASSERT_EQ(found.faults.size(), 1u) << value;
        EXPECT_EQ(found.faults[0].pointer, "/nodes/0/mesh");
        EXPECT_EQ(found.faults[0].value, value);
    }
}

TEST(GltfIndices, WhatIsNoListRefusesTheFile) {
    for (const char* list : {"nodes", "scenes", "meshes", "accessors", "bufferViews", "buffers"})
        for (const json& value : {json::object(), json(), json(1), json("x")}) {
            GltfText g = whole_scene();
            g.json[list] = value;
            auto d = described(g.json.dump(), ".gltf");
            EXPECT_FALSE(d->scene) << list;
            EXPECT_EQ(d->count("GLTF_INVALID"), 1) << d->findings();
        }
}

TEST(GltfIndices, TextThatEndsAnywhereEndsTheCheck) {
    const std::string text = whole_scene().json.dump();
    for (size_t end = 0; end < text.size(); end += 7) check_gltf_indices(text.substr(0, end));
}

TEST(GltfIndices, ASceneWithoutAnyOfItsNodesIsRefused) {
    for (const char* nodes : {R"("nodes":[{"name":"a"}],)", ""})
        for (const char* root : {"5", "4294967295", "-1"}) {
            const std::string text = std::string(R"({"asset":{"version":"2.0"},)") + nodes +
                                     R"("scene":0,"scenes":[{"nodes":[)" + root + "]}]}";
            auto d = described(text, ".gltf");
            EXPECT_FALSE(d->scene) << text;
            EXPECT_EQ(d->count("GLTF_REFERENCE"), 1) << d->findings();
            EXPECT_EQ(d->count("GLTF_INVALID"), 1) << d->findings();
            EXPECT_NE(d->findings().find(std::string("node ") + root + " is not there"),
                      std::string::npos);
        }
}

TEST(GltfIndices, WhatIsNoObjectIsLeftOutWithAWord) {
    GltfText g;
    g.node({{"mesh", g.square(g.material({{"name", "red"}}))}});
    for (const char* member : {"pbrMetallicRoughness", "normalTexture", "extensions"})
        for (const json& wrong : {json("text"), json::array({"text"}), json(4), json(true)}) {
            GltfText changed = g;
            changed.json["materials"][0][member] = wrong;
            auto d = described(changed.gltf(), ".gltf");
            ASSERT_TRUE(d->scene) << d->findings();
            EXPECT_EQ(d->count("GLTF_VALUE"), 1) << member << wrong << d->findings();
            EXPECT_NE(d->findings().find("is no object"), std::string::npos);
            EXPECT_EQ(d->scene->materials.size(), 1u);
        }
}

TEST(GltfIndices, ACoordinateSetThatAMeshLacksIsTold) {
    GltfText g;
    const int map = g.texture(1, 1, {1, 2, 3, 255}, json::object());
    const int red = g.material(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", map}, {"texCoord", 1}}}}}});
    const int mesh = g.square(red);
    g.node({{"mesh", mesh}});
    g.node({{"mesh", mesh}});
    auto d = described(g.glb());
    ASSERT_TRUE(d->scene) << d->findings();
    EXPECT_EQ(d->count("GLTF_VALUE"), 1) << d->findings();
    EXPECT_NE(d->findings().find("no TEXCOORD_1"), std::string::npos) << d->findings();
}

// In a .glb the JSON becomes longer than its chunk was.
TEST(GltfIndices, AnIndexOfAGlbThatNamesNothingLeavesTheRest) {
    GltfText g;
    const size_t shown = size_t(g.node({{"mesh", g.square()}}));
    g.node({{"mesh", -1}});
    g.node({{"mesh", 4294967296}});
    for (bool binary : {true, false}) {
        auto d = described(binary ? g.glb() : g.gltf(), binary ? ".glb" : ".gltf");
        ASSERT_TRUE(d->scene) << d->findings();
        EXPECT_EQ(d->count("GLTF_REFERENCE"), 2) << d->findings();
        EXPECT_NE(d->findings().find("mesh 4294967296 is not there"), std::string::npos);
        EXPECT_EQ(d->scene->nodes[shown].meshes.size(), 1u);
        EXPECT_EQ(d->scene->nodes[shown + 1].meshes.size(), 0u);
        EXPECT_EQ(d->scene->nodes[shown + 2].meshes.size(), 0u);
    }
}

// ---- the same in twenty files of ours and from ours

std::string file_bytes(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

std::string exported(const std::filesystem::path& path) {
    Diagnostics diagnostics;
    std::optional<SceneDescription> scene = import_scene(path.string(), {}, diagnostics);
    return scene ? export_glb(*scene, {}, diagnostics) : std::string();
}

std::vector<std::filesystem::path> sorted_files(const std::filesystem::path& folder,
                                                const std::string& ending) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().filename().string().ends_with(ending)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> twenty_files() {
    std::vector<std::string> files{whole_scene().glb(),
                                   file_bytes(project_folder() + "/assets/gltf/bender.glb")};
    for (const auto& path : sorted_files(project_folder() + "/assets/scenes", ".dae"))
        if (std::string glb = exported(path); glb.size() < 300'000) files.push_back(std::move(glb));
    // Of the validator's documents those that have something new.
    std::map<std::string, bool> known;
    for (const auto& path : sorted_files(test_data_folder() + "/rules", ".ok.dae")) {
        if (files.size() >= 20) break;
        std::string glb = exported(path);
        if (glb.empty() || glb.size() > 100'000) continue;
        bool is_new = false;
        for (const std::string& pointer :
             some_of_each_kind(number_pointers(json::parse(split_glb(glb).json)), 1))
            is_new |=
                known.try_emplace(std::regex_replace(pointer, std::regex("/\\d+"), "/*"), true)
                    .second;
        if (is_new) files.push_back(std::move(glb));
    }
    return files;
}

size_t list_size(const json& whole, const std::string& pointer) {
    const std::string list = pointer.substr(1, pointer.find('/', 1) - 1);
    return whole.contains(list) && whole[list].is_array() ? whole[list].size() : 0;
}

// One of 32 is rendered, the others are imported alone.
void try_file(const json& changed, const std::string& buffer, size_t number) {
    const std::string glb = join_glb({changed.dump(), buffer});
    if (number % 32 == 0)
        survive(glb, ".glb");
    else
        described(glb);
}

TEST(GltfIndices, NumbersAndArraysOfTwentyFilesMayBeAnything) {
    const size_t most = fuzz_setting("KINORA_FUZZ_INDICES", 1);
    const std::vector<std::string> files = twenty_files();
    ASSERT_GE(files.size(), 12u);
    size_t tried = 0;
    for (const std::string& glb : files) {
        const GlbParts parts = split_glb(glb);
        const json sound = json::parse(parts.json);
        for (const std::string& pointer : some_of_each_kind(number_pointers(sound), most)) {
            SCOPED_TRACE(pointer);
            json changed = sound;
            json& value = changed[json::json_pointer(pointer)];
            for (int64_t number : {int64_t(-1), int64_t(list_size(sound, pointer)),
                                   int64_t(1) << 31, (int64_t(1) << 32) - 1}) {
                value = number;
                try_file(changed, parts.buffer, ++tried);
            }
        }
        std::vector<std::string> arrays;
        array_pointers(sound, "", arrays);
        for (const std::string& pointer : some_of_each_kind(arrays, most)) {
            SCOPED_TRACE(pointer);
            json changed = sound;
            changed[json::json_pointer(pointer)] = {{"a", 1}};
            try_file(changed, parts.buffer, ++tried);
        }
    }
    EXPECT_GT(tried, 1000u);
    RecordProperty("files", int(files.size()));
    RecordProperty("tried", int(tried));
}

}  // namespace
}  // namespace kinora
