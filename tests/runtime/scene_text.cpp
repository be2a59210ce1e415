// tests/runtime/scene_text.cpp: COLLADA text of small scenes.
#include "scene_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "runtime/base/parallel.h"
#include "runtime/scene/build/build_scene.h"
#include "tests/folders.h"

namespace kinora {

std::string numbers(const std::vector<double>& values) {
    std::string text;
    for (double v : values) text += fmt::format("{} ", v);
    return text;
}

std::string numbers(const std::vector<dvec3>& values, int components) {
    std::string text;
    for (const dvec3& v : values)
        for (int k = 0; k < components; ++k) text += fmt::format("{} ", v[k]);
    return text;
}

namespace {

std::string source(const std::string& id, const std::string& values, size_t count,
                   const std::string& params, const char* type = "float") {
    size_t stride = params.size();
    std::string param_text;
    for (char p : params) param_text += fmt::format("<param name=\"{}\" type=\"{}\"/>", p, type);
    const char* array = std::strcmp(type, "Name") == 0 ? "Name_array" : "float_array";
    return fmt::format(
        "<source id=\"{0}\"><{1} id=\"{0}-a\" count=\"{2}\">{3}</{1}><technique_common>"
        "<accessor source=\"#{0}-a\" count=\"{4}\" stride=\"{5}\">{6}</accessor>"
        "</technique_common></source>\n",
        id, array, count * stride, values, count, stride, param_text);
}

std::string matrix_source(const std::string& id, const std::string& values, size_t count) {
    return fmt::format(
        "<source id=\"{0}\"><float_array id=\"{0}-a\" count=\"{1}\">{2}</float_array>"
        "<technique_common><accessor source=\"#{0}-a\" count=\"{3}\" stride=\"16\">"
        "<param name=\"TRANSFORM\" type=\"float4x4\"/></accessor></technique_common></source>\n",
        id, count * 16, values, count);
}

std::string bind_material(const std::string& look, const std::string& inside) {
    return fmt::format(
        "<bind_material><technique_common><instance_material symbol=\"skin\" target=\"#{}\">{}"
        "</instance_material></technique_common></bind_material>",
        look, inside);
}

std::string library(const char* kind, const std::string& content) {
    return content.empty() ? ""
                           : fmt::format("<library_{0}>\n{1}\n</library_{0}>\n", kind, content);
}

}  // namespace

SceneText& SceneText::look(const std::string& id, const std::string& code,
                           const std::string& passes, const std::string& newparams,
                           const std::string& material_extra) {
    effects += fmt::format(
        "<effect id=\"{0}-fx\">{1}<profile_RSL><technique sid=\"default\">"
        "<code><![CDATA[\n{2}\n]]></code><pass>{3}</pass></technique></profile_RSL></effect>\n",
        id, newparams, code, passes);
    materials +=
        fmt::format("<material id=\"{0}\"><instance_effect url=\"#{0}-fx\"/>{1}</material>\n", id,
                    material_extra);
    return *this;
}

SceneText floor_scene(const std::string& code, const std::string& passes) {
    SceneText scene;
    scene.square("floor", 1.5).look("floor-look", code, passes).place("floor", "floor-look");
    return scene;
}

std::string rsl_extra(const std::string& inside) {
    return "<extra><technique profile=\"RSL\">" + inside + "</technique></extra>";
}

SceneText& SceneText::scene_effect(const std::string& id, const std::string& code,
                                   const std::string& passes) {
    scene_extra += rsl_extra(fmt::format("<instance_effect url=\"#{}-fx\"/>", id));
    return look(id, code, passes);
}

SceneText& SceneText::cube(const std::string& id, double s) {
    std::vector<dvec3> corners;
    for (int k = 0; k < 8; ++k) corners.push_back({k & 1 ? s : -s, k & 2 ? s : -s, k & 4 ? s : -s});
    std::vector<int> triangles;
    const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads)
        for (int k : {0, 1, 2, 0, 2, 3}) triangles.push_back(q[k]);
    return mesh(id, corners, triangles);
}

SceneText& SceneText::mesh(const std::string& id, const std::vector<dvec3>& positions,
                           const std::vector<int>& triangles, const std::vector<dvec3>& normals,
                           const std::vector<dvec3>& uvs) {
    std::string sources = source(id + "-p", numbers(positions), positions.size(), "XYZ");
    std::string inputs =
        fmt::format("<input semantic=\"VERTEX\" source=\"#{}-v\" offset=\"0\"/>", id);
    if (!normals.empty()) {
        sources += source(id + "-n", numbers(normals), normals.size(), "XYZ");
        inputs += fmt::format("<input semantic=\"NORMAL\" source=\"#{}-n\" offset=\"0\"/>", id);
    }
    if (!uvs.empty()) {
        sources += source(id + "-t", numbers(uvs, 2), uvs.size(), "ST");
        inputs += fmt::format(
            "<input semantic=\"TEXCOORD\" source=\"#{}-t\" offset=\"0\" set=\"0\"/>", id);
    }
    std::string p;
    for (int index : triangles) p += fmt::format("{} ", index);
    geometries += fmt::format(
        "<geometry id=\"{0}\"><mesh>{1}<vertices id=\"{0}-v\"><input semantic=\"POSITION\" "
        "source=\"#{0}-p\"/></vertices><triangles material=\"skin\" count=\"{2}\">{3}<p>{4}</p>"
        "</triangles></mesh></geometry>\n",
        id, sources, triangles.size() / 3, inputs, p);
    return *this;
}

SceneText& SceneText::square(const std::string& id, double s) {
    return mesh(id, {{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}}, {0, 1, 2, 0, 2, 3},
                std::vector<dvec3>(4, dvec3(0, 0, 1)),
                {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
}

SceneText& SceneText::octahedron(const std::string& id) {
    const std::vector<dvec3> points{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                    {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    return mesh(id, points,
                {0, 2, 4, 4, 2, 1, 1, 2, 5, 5, 2, 0, 4, 3, 0, 1, 3, 4, 5, 3, 1, 0, 3, 5}, points);
}

SceneText& SceneText::place(const std::string& mesh, const std::string& look,
                            const std::string& transforms, const std::string& node_id,
                            const std::string& inside) {
    nodes += fmt::format("<node{}>{}<instance_geometry url=\"#{}\">{}</instance_geometry></node>\n",
                         node_id.empty() ? "" : fmt::format(" id=\"{}\"", node_id), transforms,
                         mesh, look.empty() ? "" : bind_material(look, inside));
    return *this;
}

SceneText& SceneText::light(const std::string& id, const std::string& kind,
                            const std::string& transforms, const std::string& extra) {
    lights += fmt::format("<light id=\"{}\"><technique_common>{}</technique_common>{}</light>\n",
                          id, kind, extra);
    nodes += fmt::format("<node id=\"{0}-node\">{1}<instance_light url=\"#{0}\"/></node>\n", id,
                         transforms);
    return *this;
}

SceneText& SceneText::rsl_light(const std::string& id, const std::string& code,
                                const std::string& transforms, const std::string& binds) {
    look(id + "-look", code, fmt::format("<shader stage=\"LIGHT\">{}</shader>", binds));
    return light(id, "<point><color>1 1 1</color></point>", transforms,
                 fmt::format("<extra><technique profile=\"RSL\"><instance_effect "
                             "url=\"#{}-look-fx\"/></technique></extra>",
                             id));
}

SceneText& SceneText::animate(const std::string& target, const std::vector<double>& times,
                              const std::vector<double>& values) {
    std::string id = fmt::format("anim{}", animations.size());
    std::string linear;
    for (size_t i = 0; i < times.size(); ++i) linear += "LINEAR ";
    animations += fmt::format(
        "<animation>{1}{2}{3}<sampler id=\"{0}-s\"><input semantic=\"INPUT\" source=\"#{0}-i\"/>"
        "<input semantic=\"OUTPUT\" source=\"#{0}-o\"/>"
        "<input semantic=\"INTERPOLATION\" source=\"#{0}-k\"/></sampler>"
        "<channel source=\"#{0}-s\" target=\"{4}\"/></animation>\n",
        id, source(id + "-i", numbers(times), times.size(), "T"),
        source(id + "-o", numbers(values), values.size(), "X"),
        source(id + "-k", linear, times.size(), "I", "Name"), target);
    return *this;
}

SceneText& SceneText::bending_strip(const std::string& id, const std::string& look_id,
                                    int segments) {
    std::vector<dvec3> positions, normals, uvs;
    std::vector<int> triangles;
    std::string vcount, v;
    std::vector<double> weights{1};
    for (int i = 0; i <= segments; ++i) {
        double t = double(i) / segments, w = std::clamp(2 * t - 0.5, 0.0, 1.0);
        for (int side = 0; side < 2; ++side) {
            positions.push_back({side ? 0.3 : -0.3, 2 * t - 1, 0});
            normals.push_back({0, 0, 1});
            uvs.push_back({double(side), t, 0});
            vcount += "2 ";
            v += fmt::format("0 {} 1 {} ", weights.size(), weights.size() + 1);
        }
        weights.push_back(1 - w);
        weights.push_back(w);
    }
    for (int i = 0; i < segments; ++i)
        for (int k : {0, 1, 3, 0, 3, 2}) triangles.push_back(2 * i + k);
    mesh(id + "-mesh", positions, triangles, normals, uvs);
    std::string inverse = "1 0 0 0 0 1 0 1 0 0 1 0 0 0 0 1  1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
    controllers += fmt::format(
        "<controller id=\"{0}\"><skin source=\"#{0}-mesh\"><bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 "
        "1 0 0 0 0 1</bind_shape_matrix>{1}{2}{3}<joints><input semantic=\"JOINT\" "
        "source=\"#{0}-j\"/><input semantic=\"INV_BIND_MATRIX\" source=\"#{0}-b\"/></joints>"
        "<vertex_weights count=\"{4}\"><input semantic=\"JOINT\" source=\"#{0}-j\" offset=\"0\"/>"
        "<input semantic=\"WEIGHT\" source=\"#{0}-w\" offset=\"1\"/><vcount>{5}</vcount><v>{6}</v>"
        "</vertex_weights></skin></controller>\n",
        id, source(id + "-j", "lower upper", 2, "J", "Name"), matrix_source(id + "-b", inverse, 2),
        source(id + "-w", numbers(weights), weights.size(), "W"), positions.size(), vcount, v);
    nodes += fmt::format(
        "<node id=\"{0}-root\" sid=\"lower\" type=\"JOINT\"><translate>0 -1 0</translate>"
        "<node id=\"{0}-upper\" sid=\"upper\" type=\"JOINT\"><translate>0 1 0</translate>"
        "<rotate sid=\"turn\">0 0 1 0</rotate></node></node>"
        "<node id=\"{0}-node\"><instance_controller url=\"#{0}\"><skeleton>#{0}-root</skeleton>{1}"
        "</instance_controller></node>\n",
        id, bind_material(look_id, ""));
    return animate(id + "-upper/turn.ANGLE", {0, 1}, {0, 80});
}

std::string SceneText::text() const {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
        "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
        "<asset><created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>{}"
        "</asset>\n{}{}{}{}{}{}{}{}{}<library_visual_scenes><visual_scene id=\"scene\">\n{}{}{}"
        "</visual_scene></library_visual_scenes>\n"
        "<scene><instance_visual_scene url=\"#scene\"/></scene>\n</COLLADA>\n",
        asset, library("images", images), library("effects", effects),
        library("materials", materials), library("geometries", geometries),
        library("controllers", controllers), library("lights", lights), library("cameras", cameras),
        library("animations", animations), library("nodes", library_nodes), camera_node, nodes,
        scene_extra);
}

// ---- pictures

Rendering::Rendering(const std::string& document, const SceneOptions& options) {
    static int number = 0;
    std::string path = (std::filesystem::temp_directory_path() /
                        fmt::format("kinora_runtime_test_{}_{}.dae", getpid(), number++))
                           .string();
    file_text = document;
    std::ofstream(path) << document;
    load(path, options);
    std::filesystem::remove(path);
}

std::unique_ptr<Rendering> Rendering::of_file(const std::string& path,
                                              const SceneOptions& options) {
    std::unique_ptr<Rendering> result(new Rendering());
    result->load(path, options);
    return result;
}

void Rendering::load(const std::string& path, const SceneOptions& options) {
    settings.width = settings.height = 16;
    ImportOptions import_options;
    import_options.allow_external = {project_folder() + "/assets/shaders"};  // tests include them
    auto description = import_scene(path, import_options, diagnostics);
    if (!description) return;
    SceneOptions printing = options;
    if (!printing.print)
        printing.print = [](std::string_view text) {
            std::fwrite(text.data(), 1, text.size(), stdout);
        };
    scene = build_scene(std::make_shared<SceneDescription>(std::move(*description)), printing,
                        diagnostics);
    if (scene) pose = std::make_unique<Pose>(*scene);
}

Rendering& Rendering::frame(double time) {
    if (!scene) {
        ADD_FAILURE() << "no scene\n" << findings();
        film.resize(settings.width, settings.height);
        return *this;
    }
    EXPECT_TRUE(render_frame(*scene, *pose, time, settings, film, stats, diagnostics))
        << findings();
    return *this;
}

Rendering& Rendering::frame(int width, int height, double time) {
    settings.width = width;
    settings.height = height;
    return frame(time);
}

dvec2 Rendering::place(int x, int y) const {
    return {-1 + 2 * (x + 0.5) / film.width, 1 - 2 * (y + 0.5) / film.height};
}

int Rendering::count(std::string_view code) const {
    int n = 0;
    for (const Finding& finding : diagnostics.findings()) n += finding.info->code == code;
    return n;
}

const Finding* Rendering::find(std::string_view code) const {
    for (const Finding& finding : diagnostics.findings())
        if (finding.info->code == code) return &finding;
    return nullptr;
}

std::string Rendering::findings() const {
    std::string text;
    for (const Finding& finding : diagnostics.findings())
        text += format_finding(finding, diagnostics.files);
    return text;
}

LineColumn Rendering::where(const Finding& finding) const {
    if (finding.where.file == kNoFile) return {};
    return diagnostics.files.line_column(finding.where.file, finding.where.begin);
}

float difference(const raytrace::Film& a, const raytrace::Film& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    float most = 0;
    for (size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i)
        for (int k = 0; k < 4; ++k) most = std::max(most, std::abs(a.rgba[i][k] - b.rgba[i][k]));
    return most;
}

size_t different_pixels(const raytrace::Film& a, const raytrace::Film& b, float tolerance) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    size_t count = 0;
    for (size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i) {
        bool differs = false;
        for (int k = 0; k < 4; ++k)
            differs |= !(std::abs(a.rgba[i][k] - b.rgba[i][k]) <= tolerance);
        count += differs;
    }
    return count;
}

bool same_bytes(const raytrace::Film& a, const raytrace::Film& b) {
    return a.rgba.size() == b.rgba.size() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(vec4)) == 0;
}

Threads::Threads(int n) : before_(thread_count()) {
    set_thread_count(n);
}
Threads::~Threads() {
    set_thread_count(before_);
}

}  // namespace kinora
