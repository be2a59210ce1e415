// tests/runtime/scene/gltf/gltf_text.cpp: glTF containers, buffers and PNGs.
#include "tests/runtime/scene/gltf/gltf_text.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "runtime/scene/build/build_scene.h"
#include "runtime/scene/gltf/import/import.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

using nlohmann::json;

namespace {

template <class T>
int appended(json& object, const char* array, T&& value) {
    object[array].push_back(std::forward<T>(value));
    return int(object[array].size()) - 1;
}

std::string temporary(const char* extension) {
    static int number = 0;
    return (std::filesystem::temp_directory_path() /
            fmt::format("kinora_gltf_test_{}_{}{}", getpid(), number++, extension))
        .string();
}

std::string base64(const std::vector<uint8_t>& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t block = uint32_t(bytes[i]) << 16;
        if (i + 1 < bytes.size()) block |= uint32_t(bytes[i + 1]) << 8;
        if (i + 2 < bytes.size()) block |= bytes[i + 2];
        for (size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kDigits[block >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string word(uint32_t value) {
    return {char(value), char(value >> 8), char(value >> 16), char(value >> 24)};
}

}  // namespace

GltfText::GltfText() {
    json = nlohmann::json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "eye-node", "camera": 0, "translation": [0, 0, 10]}],
        "cameras": [{"name": "eye", "type": "orthographic",
                     "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 100}}]})");
}

int GltfText::view(const void* data, size_t size, int stride) {
    while (bytes.size() % 4) bytes.push_back(0);
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
    if (stride) view["byteStride"] = stride;
    auto first = static_cast<const uint8_t*>(data);
    bytes.insert(bytes.end(), first, first + size);
    return appended(json, "bufferViews", view);
}

int GltfText::accessor(int view, int component_type, size_t count, const char* type,
                       size_t byte_offset, bool normalized) {
    nlohmann::json a = {{"componentType", component_type}, {"count", count}, {"type", type}};
    if (view >= 0) a["bufferView"] = view;
    if (byte_offset) a["byteOffset"] = byte_offset;
    if (normalized) a["normalized"] = true;
    return appended(json, "accessors", a);
}

int GltfText::floats(const std::vector<float>& values, const char* type) {
    std::string_view t = type;
    size_t width = t == "SCALAR" ? 1 : t == "MAT4" ? 16 : size_t(t[3] - '0');
    return accessor(view(values.data(), values.size() * 4), 5126, values.size() / width, type);
}

int GltfText::shorts(const std::vector<uint16_t>& values) {
    return accessor(view(values.data(), values.size() * 2), 5123, values.size(), "SCALAR");
}

int GltfText::mesh(nlohmann::json attributes, int indices, int material, int mode) {
    nlohmann::json primitive = {{"attributes", std::move(attributes)}, {"mode", mode}};
    if (indices >= 0) primitive["indices"] = indices;
    if (material >= 0) primitive["material"] = material;
    return appended(json, "meshes", nlohmann::json{{"primitives", {primitive}}});
}

int GltfText::node(nlohmann::json node) {
    int index = appended(json, "nodes", std::move(node));
    json["scenes"][0]["nodes"].push_back(index);
    return index;
}

int GltfText::material(nlohmann::json material) {
    return appended(json, "materials", std::move(material));
}

int GltfText::square(int material, float size) {
    float s = size;
    nlohmann::json attributes = {
        {"POSITION", floats({-s, -s, 0, s, -s, 0, s, s, 0, -s, s, 0}, "VEC3")},
        {"NORMAL", floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
        {"TEXCOORD_0", floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2")}};
    return mesh(std::move(attributes), shorts({0, 1, 2, 0, 2, 3}), material);
}

int GltfText::texture(int width, int height, const std::vector<uint8_t>& rgba,
                      nlohmann::json sampler) {
    Image8 image;
    image.width = width;
    image.height = height;
    image.rgba = rgba;
    std::string path = temporary(".png");
    write_png(path, image, {});
    std::ifstream file(path, std::ios::binary);
    std::string png((std::istreambuf_iterator<char>(file)), {});
    std::filesystem::remove(path);
    int source = appended(
        json, "images",
        nlohmann::json{{"bufferView", view(png.data(), png.size())}, {"mimeType", "image/png"}});
    int index = appended(json, "samplers", std::move(sampler));
    return appended(json, "textures", nlohmann::json{{"source", source}, {"sampler", index}});
}

void GltfText::animate(int animation, int node, const char* path, const char* interpolation,
                       const std::vector<float>& times, const std::vector<float>& values) {
    std::string_view kind = path;
    const char* type = kind == "rotation" ? "VEC4" : kind == "weights" ? "SCALAR" : "VEC3";
    auto& target = json["animations"][size_t(animation)];
    int sampler = appended(target, "samplers",
                           nlohmann::json{{"input", floats(times, "SCALAR")},
                                          {"output", floats(values, type)},
                                          {"interpolation", interpolation}});
    appended(target, "channels",
             nlohmann::json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
}

std::string GltfText::glb() const {
    nlohmann::json whole = json;
    if (!bytes.empty()) whole["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary(bytes.begin(), bytes.end());
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string content = word(uint32_t(text.size())) + "JSON" + text;
    if (!binary.empty())
        content += word(uint32_t(binary.size())) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(uint32_t(content.size() + 12)) + content;
}

std::string GltfText::gltf() const {
    nlohmann::json whole = json;
    if (!bytes.empty())
        whole["buffers"] = {{{"byteLength", bytes.size()},
                             {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
    return whole.dump(1);
}

GltfFileOnDisk::GltfFileOnDisk(const std::string& content, const char* extension)
    : path_(temporary(extension)) {
    std::ofstream(path_, std::ios::binary) << content;
}

GltfFileOnDisk::~GltfFileOnDisk() {
    std::filesystem::remove(path_);
}

std::unique_ptr<Rendering> rendering_of(const GltfText& scene, const SceneOptions& options) {
    GltfFileOnDisk file(scene.glb());
    return Rendering::of_file(file.path(), options);
}

int GltfDescription::count(std::string_view code) const {
    int n = 0;
    for (const Finding& finding : diagnostics.findings()) n += finding.info->code == code;
    return n;
}

std::string GltfDescription::findings() const {
    std::string text;
    for (const Finding& finding : diagnostics.findings())
        text += format_finding(finding, diagnostics.files);
    return text;
}

std::unique_ptr<GltfDescription> described(const std::string& content, const char* extension) {
    auto result = std::make_unique<GltfDescription>();
    GltfFileOnDisk file(content, extension);
    result->scene = import_gltf(file.path(), {}, result->diagnostics);
    return result;
}

GltfText whole_scene() {
    GltfText g;
    int t = g.texture(1, 1, {255, 255, 255, 255}, json::object());
    int m = g.material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", t}}}}}});
    int mesh = g.square(m);
    g.json["meshes"][size_t(mesh)]["primitives"][0]["targets"] = {
        {{"POSITION", g.floats(std::vector<float>(12, 0.5f), "VEC3")}}};
    std::vector<uint8_t> joints(16, 0);
    std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    auto& attributes = g.json["meshes"][size_t(mesh)]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = g.accessor(g.view(joints.data(), 16), 5121, 4, "VEC4");
    attributes["WEIGHTS_0"] = g.floats(weights, "VEC4");
    int joint = g.node({{"name", "joint"}});
    g.json["skins"] = {{{"joints", {joint}},
                        {"inverseBindMatrices",
                         g.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4")}}};
    int node = g.node({{"mesh", mesh}, {"skin", 0}, {"children", json::array()}});
    g.json["extensionsUsed"] = {"KHR_lights_punctual"};
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
    g.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    g.json["animations"].push_back({{"name", "move"}});
    g.animate(0, joint, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 1, 0, 0, 0});
    g.animate(0, node, "weights", "STEP", {0, 1}, {0, 1});
    return g;
}

void survive(const std::string& content, const char* extension) {
    auto d = described(content, extension);
    if (!d->scene) {
        EXPECT_TRUE(d->diagnostics.has_errors());
        return;
    }
    auto scene =
        build_scene(std::make_shared<SceneDescription>(std::move(*d->scene)), {}, d->diagnostics);
    if (!scene) return;
    Pose pose(*scene);
    FrameSettings settings;
    settings.width = settings.height = 4;
    raytrace::Film film;
    FrameStats stats;
    render_frame(*scene, pose, 0.5, settings, film, stats, d->diagnostics);
}

}  // namespace kinora
