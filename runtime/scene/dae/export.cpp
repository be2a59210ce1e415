// runtime/scene/dae/export.cpp: the COLLADA document and its nodes.
#include "runtime/scene/dae/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "collada/document/document.h"
#include "collada/document/edit.h"
#include "collada/document/write.h"
#include "runtime/base/numbers.h"
#include "runtime/scene/dae/export_p.h"
#include "runtime/scene/description/display_color.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/interface_losses.h"
#include "runtime/scene/description/picture_rules.h"
#include "runtime/scene/transforms.h"

namespace kinora {

std::string xml(const std::string& name, const std::string& attributes,
                const std::string& content) {
    return fmt::format("<{0}{1}>{2}</{0}>", name, attributes, content);
}

std::string attribute(const std::string& name, const std::string& value) {
    return " " + collada::attribute_text(name, value);
}

std::string input(const char* semantic, const std::string& source, int offset, uint32_t set) {
    std::string attributes = attribute("semantic", semantic) + attribute("source", "#" + source);
    if (offset >= 0) attributes += attribute("offset", std::to_string(offset));
    if (set != kNone) attributes += attribute("set", std::to_string(set));
    return "<input" + attributes + "/>";
}

namespace {

// The digits of a float; all of the double that it is where these are few more, as of
// 3512345.25, whose neighbours among the floats are far.
std::string float_text(float x) {
    constexpr size_t kFewMore = 3;
    std::string digits = fmt::format("{}", x), all = fmt::format("{}", double(x));
    return all.size() <= digits.size() + kFewMore ? all : digits;
}

// XML Schema 1.0, 3.2.5: what xs:double calls the numbers that have no digits.
template <class T>
std::string list_text(std::span<const T> numbers, auto&& digits_of) {
    std::string text;
    for (T x : numbers) {
        if (!text.empty()) text += ' ';
        text += std::isnan(x) ? "NaN" : std::isinf(x) ? (x > 0 ? "INF" : "-INF") : digits_of(x);
    }
    return text;
}

}  // namespace

std::string number_text(std::span<const double> numbers) {
    return list_text(numbers, [](double x) {
        return double(float(x)) == x ? float_text(float(x))
                                     : collada::shortest_number(fmt::format("{:.15g}", x));
    });
}

std::string number_text(std::span<const float> numbers) {
    return list_text(numbers, float_text);
}

std::string float_source(const std::string& id, const std::string& numbers, size_t count,
                         const std::vector<std::string>& params, const char* type) {
    std::string list;
    for (const std::string& p : params)
        list += fmt::format("<param name=\"{}\" type=\"{}\"/>", p, type);
    bool matrix = std::string_view(type) == "float4x4";
    size_t width = matrix ? 16 : params.size();
    return fmt::format(
        "<source id=\"{0}\"><float_array id=\"{0}-array\" count=\"{1}\">{2}</float_array>"
        "<technique_common><accessor source=\"#{0}-array\" count=\"{3}\" stride=\"{4}\">{5}"
        "</accessor></technique_common></source>",
        id, count * width, numbers, count, width, list);
}

dvec3 short_display_color(const dvec3& linear, double error) {
    dvec3 display = display_of_linear(linear);
    for (int digits = 6; digits < 17; ++digits) {
        dvec3 rounded;
        for (int k = 0; k < 3; ++k)
            rounded[k] = number_of<double>(fmt::format("{:.{}g}", display[k], digits)).value_or(0);
        dvec3 off = glm::abs(linear_of_display(rounded) - linear);
        if (glm::all(glm::lessThanEqual(off, error * glm::abs(linear)))) return rounded;
    }
    return display;
}

namespace {

bool is_identity(const dmat4& m) {
    return m == dmat4(1.0);
}

std::string matrix_text(const dmat4& m) {
    std::vector<double> rows;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) rows.push_back(m[c][r]);
    return number_text(rows);
}

constexpr const char* kXyz[] = {".X", ".Y", ".Z"};
// As Maya's and Max's exporters say it, and collada/extract/nodes.cpp reads it.
constexpr const char* kHidden =
    "<extra><technique profile=\"FCOLLADA\"><visibility>0</visibility></technique></extra>";
constexpr const char* kRotate[] = {".X", ".Y", ".Z", ".ANGLE"};

}  // namespace

std::string xml_name(const std::string& wanted) {
    std::string name;
    for (char c : collada::xml_characters(wanted))
        name += std::isalnum(uint8_t(c)) || c == '_' || c == '-' || uint8_t(c) >= 0x80 ? c : '_';
    bool starts = name.empty() || std::isdigit(uint8_t(name[0])) || name[0] == '-';
    return starts ? "_" + name : name;
}

// An XML name that no other element has.
std::string ColladaExporter::id(const std::string& wanted, const char* kind) {
    return names_.name(wanted, kind);
}

void ColladaExporter::lost(const std::string& what, const std::string& why, Location where) {
    diagnostics_.report(Code::CONVERT_LOST, where, what, why);
}

// Text for XML; what cannot stand in it is told.
const std::string& ColladaExporter::told(const std::string& text, const std::string& what) {
    if (collada::xml_characters(text) != collada::utf8_text(text))
        lost(what, "a control character in its text (a space stands for it)");
    return text;
}

std::span<const double> ColladaExporter::values(ValueSlot slot) const {
    if (!slot.present()) return {};
    return std::span(description_.values).subspan(slot.offset, slot.count);
}

void ColladaExporter::name_all() {
    auto names = [&](const auto& list, const char* kind, std::vector<std::string>& ids) {
        for (const auto& item : list)
            ids.push_back(id(item.id.empty() ? item.name : item.id, kind));
    };
    names(description_.nodes, "node", node_ids_);
    names(description_.meshes, "mesh", mesh_ids_);
    names(description_.materials, "material", material_ids_);
    names(description_.lights, "light", light_ids_);
    names(description_.cameras, "camera", camera_ids_);
    size_t count = description_.nodes.size();
    uses_.assign(count, 0);
    parents_.assign(count, kNone);
    joint_.assign(count, false);
    for (const ChildUse& root : description_.roots) ++uses_[root.node];
    for (uint32_t n = 0; n < count; ++n) {
        for (const ChildUse& c : description_.nodes[n].children) {
            ++uses_[c.node];
            parents_[c.node] = n;
        }
        for (const MeshUse& use : description_.nodes[n].meshes) {
            for (uint32_t joint : use.joint_nodes)
                if (joint != kNone) joint_[joint] = true;
            for (const MaterialUse& m : use.materials)
                if (m.material != kNone && is_rsl(description_.materials[m.material]))
                    rsl_groups_.emplace(use.mesh, m.symbol);
        }
    }
}

std::string ColladaExporter::asset() const {
    // The schema asks for dates; none keeps the bytes the same for the same input.
    static constexpr const char* kAxes[] = {"X_UP", "Y_UP", "Z_UP"};
    return fmt::format(
        "<asset><contributor><authoring_tool>kinora-convert</authoring_tool></contributor>"
        "<created>1970-01-01T00:00:00Z</created><modified>1970-01-01T00:00:00Z</modified>"
        "<unit meter=\"{}\" name=\"{}\"/><up_axis>{}</up_axis></asset>",
        collada::shortest_number(description_.meter), description_.meter == 1 ? "meter" : "unit",
        kAxes[size_t(description_.up_axis)]);
}

std::string ColladaExporter::transform(const Transform& t, const std::string& node, size_t number) {
    struct Row {
        const char* name;
        uint32_t count;
        const char* const* members;
    };
    static constexpr Row kRows[] = {{"translate", 3, kXyz}, {"rotate", 4, kRotate},
                                    {"scale", 3, kXyz},     {"matrix", 16, nullptr},
                                    {"lookat", 9, nullptr}, {"skew", 7, nullptr}};
    std::string sid = fmt::format(
        "{}{}", size_t(t.kind) < std::size(kRows) ? kRows[size_t(t.kind)].name : "rotation",
        number);
    std::string target = node + "/" + sid;
    auto where = [&](ValueSlot slot) {
        return animation_.moves(slot) ? attribute("sid", sid) : "";
    };
    if (size_t(t.kind) < std::size(kRows)) {
        const Row& row = kRows[size_t(t.kind)];
        ValueSlot slot{t.value, row.count};
        animation_.name(slot, target, row.members);
        return xml(row.name, where(slot), number_text(values(slot)));
    }
    ValueSlot slot{t.value, 4};
    std::optional<dvec3> axis = animation_.hinge(t.value);
    animation_.name_rotation(t.value, target, axis);
    const double* quaternion = &description_.values[t.value];
    dmat4 m(mat4(transform_matrix(t.kind, quaternion)));  // glTF's are floats
    if (!animation_.moves(slot) && is_identity(m)) return "";
    if (!axis) return xml("matrix", where(slot), matrix_text(m));
    float angle = float(angle_about(*axis, quaternion));
    return xml("rotate", where(slot),
               number_text(std::array{float(axis->x), float(axis->y), float(axis->z), angle}));
}

// Which inputs the material reads: all that RSL may read, and texture coordinates by their names.
std::string ColladaExporter::vertex_inputs(const MaterialUse& use,
                                           const PrimitiveGroup& group) const {
    const MaterialDefinition& material = description_.materials[use.material];
    bool rsl = is_rsl(material);
    std::set<std::string> names;
    for (const ShaderUse& surface : material.surfaces)
        for (const ParamSource& p : surface.params) names.insert(p.texcoord);
    std::string text;
    for (const VertexBinding& b : use.vertex_bindings) {
        bool there = std::any_of(
            group.attributes.begin(), group.attributes.end(), [&](const VertexAttribute& a) {
                return a.semantic == b.semantic && (b.set == kNone || a.set == b.set);
            });
        bool read = rsl || b.semantic != "TEXCOORD" || names.contains(b.param);
        if (!there || !read) continue;
        text += fmt::format("<bind_vertex_input{}{}{}/>", attribute("semantic", b.param),
                            attribute("input_semantic", b.semantic),
                            b.set == kNone ? "" : attribute("input_set", std::to_string(b.set)));
    }
    return text;
}

std::string ColladaExporter::light_list(const std::vector<uint32_t>& lights) const {
    std::string list;
    for (uint32_t light : lights)
        list += xml("instance_light", attribute("url", "#" + light_ids_[light]), "");
    return xml("extra", "", xml("technique", attribute("profile", "RSL"), xml("lights", "", list)));
}

std::string ColladaExporter::mesh_instance(const MeshUse& use) {
    const MeshDefinition& mesh = description_.meshes[use.mesh];
    bool controlled = use.skin != kNone || use.morph != kNone;
    std::string url = controlled ? controller(use) : mesh_ids_[use.mesh];
    std::string content, materials;
    if (use.skin != kNone) {
        std::set<std::string> roots;
        for (uint32_t joint : use.joint_nodes) {
            if (joint == kNone) continue;
            uint32_t top = joint;
            while (parents_[top] != kNone) top = parents_[top];
            if (roots.insert(node_ids_[top]).second)
                content += xml("skeleton", "", "#" + node_ids_[top]);
        }
    }
    for (const MaterialUse& m : use.materials) {
        auto worn = std::find_if(mesh.groups.begin(), mesh.groups.end(),
                                 [&](const PrimitiveGroup& g) { return g.symbol == m.symbol; });
        if (m.material == kNone || worn == mesh.groups.end()) continue;
        materials += xml("instance_material",
                         attribute("symbol", xml_name(m.symbol)) +
                             attribute("target", "#" + material_ids_[m.material]),
                         vertex_inputs(m, *worn));
    }
    if (!materials.empty())
        content += xml("bind_material", "", xml("technique_common", "", materials));
    if (use.lights) content += light_list(*use.lights);
    return xml(controlled ? "instance_controller" : "instance_geometry",
               attribute("url", "#" + url), content);
}

std::string ColladaExporter::child(const ChildUse& use) {
    std::string text = uses_[use.node] > 1
                           ? xml("instance_node", attribute("url", "#" + node_ids_[use.node]), "")
                           : node(use.node);
    if (is_identity(use.conversion) && uses_[use.node] <= 1) return text;
    std::string matrix =
        is_identity(use.conversion) ? "" : xml("matrix", "", matrix_text(use.conversion));
    return xml("node", "", matrix + text);
}

std::string ColladaExporter::node(uint32_t index) {
    const NodeDefinition& definition = description_.nodes[index];
    const std::string& own = node_ids_[index];
    std::string attributes = attribute("id", own);
    if (!definition.name.empty()) attributes += attribute("name", xml_name(definition.name));
    if (joint_[index]) attributes += attribute("sid", own) + attribute("type", "JOINT");
    std::string cameras, controllers, geometries, lights, nodes, content, extra;
    for (size_t t = 0; t < definition.transforms.size(); ++t)
        content += transform(definition.transforms[t], own, t);
    for (uint32_t c : definition.cameras)
        cameras += xml("instance_camera", attribute("url", "#" + camera_ids_[c]), "");
    for (const MeshUse& use : definition.meshes) {
        std::string instance = mesh_instance(use);
        // A skin without bind shape would follow its node, too (docs/format.md#skins-and-morphs):
        // it stands alone.
        if (use.skin != kNone)
            skinned_ += xml("node", attribute("id", id(own + "-skin", "skin")),
                            instance + (is_below_hidden(index) ? kHidden : ""));
        else if (!is_identity(use.conversion))
            nodes += xml("node", "", xml("matrix", "", matrix_text(use.conversion)) + instance);
        else
            (use.morph != kNone ? controllers : geometries) += instance;
    }
    for (uint32_t l : definition.lights)
        lights += xml("instance_light", attribute("url", "#" + light_ids_[l]), "");
    for (const ChildUse& c : definition.children) nodes += child(c);
    for (const UserAttribute& a : definition.attributes) {
        std::string what = fmt::format("node '{}'", own);
        extra += xml(
            "attribute", attribute("name", told(a.name, what)),
            a.numbers.empty() ? collada::escape_text(told(a.text, what)) : number_text(a.numbers));
    }
    if (!extra.empty())
        extra = xml("extra", "", xml("technique", attribute("profile", "RSL"), extra));
    if (hides(definition)) extra += kHidden;
    return xml("node", attributes,
               content + cameras + controllers + geometries + lights + nodes + extra);
}

bool ColladaExporter::is_below_hidden(uint32_t node) const {
    for (; node != kNone; node = parents_[node])
        if (hides(description_.nodes[node])) return true;
    return false;
}

std::string ColladaExporter::library(const char* name, const std::string& content) const {
    return content.empty() ? "" : xml(std::string("library_") + name, "", content);
}

// `image`: the id of its picture, or "".
static std::string environment_extra(const EnvironmentDefinition& around,
                                     const std::string& image) {
    auto number = [](const char* name, double value, double usual) {
        return value == usual ? "" : xml(name, "", number_text(std::span<const double>(&value, 1)));
    };
    const double color[] = {around.color.x, around.color.y, around.color.z};
    std::string parts;
    if (!image.empty()) parts += xml("instance_image", attribute("url", "#" + image), "");
    if (image.empty() || around.color != dvec3(1.0)) parts += xml("color", "", number_text(color));
    parts += number("rotation", around.rotation, 0) + number("brightness", around.brightness, 1);
    if (!around.behind_picture) parts += xml("hidden", "", "true");
    return xml("extra", "",
               xml("technique", attribute("profile", "RSL"), xml("environment", "", parts)));
}

ColladaExport ColladaExporter::run() {
    name_all();
    merge_vertices();
    for (std::string_view what : interface_losses(description_))
        lost("the scene", std::string(what));
    std::string shared, tops, geometries, lights, cameras, scene_extra;
    for (uint32_t n = 0; n < description_.nodes.size(); ++n)
        if (uses_[n] > 1) shared += node(n);
    for (const ChildUse& root : description_.roots) tops += child(root);
    tops += skinned_;
    for (uint32_t m = 0; m < description_.meshes.size(); ++m) geometries += geometry(m);
    for (uint32_t m = 0; m < description_.materials.size(); ++m) {
        std::string name = effect(m), sides;  // of the VOLUME shaders, in the effect's order
        for (size_t k = 0; k < description_.materials[m].interior.size(); ++k) sides += " interior";
        for (size_t k = 0; k < description_.materials[m].exterior.size(); ++k) sides += " exterior";
        if (description_.materials[m].exterior.empty()) sides.clear();  // interiors need no word
        std::string extra;
        if (!sides.empty())
            extra =
                xml("extra", "",
                    xml("technique",
                        attribute("profile", "RSL") + attribute("target", sides.substr(1)), ""));
        materials_ += xml("material",
                          attribute("id", material_ids_[m]) +
                              (description_.materials[m].name.empty()
                                   ? ""
                                   : attribute("name", xml_name(description_.materials[m].name))),
                          xml("instance_effect", attribute("url", "#" + name), "") + extra);
    }
    for (uint32_t l = 0; l < description_.lights.size(); ++l) lights += light(l);
    for (uint32_t c = 0; c < description_.cameras.size(); ++c) cameras += camera(c);
    std::vector<ShaderUse> picture = description_.picture.atmosphere;
    picture.insert(picture.end(), description_.picture.imagers.begin(),
                   description_.picture.imagers.end());
    if (tops.empty()) tops = "<node/>";
    tops += rsl_extra(picture, "scene");
    if (const auto& around = description_.environment)
        tops += environment_extra(*around, around->picture.empty() ? "" : image(around->picture));
    CurveList::Text curves = animation_.text(diagnostics_);
    std::string scene = xml("visual_scene", attribute("id", id("scene", "scene")),
                            tops + animation_.played_range());
    std::string scene_id = scene.substr(scene.find('"') + 1);
    scene_id = scene_id.substr(0, scene_id.find('"'));
    std::string text =
        "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">" +
        asset() + library("animations", curves.animations) +
        library("animation_clips", curves.clips) + library("cameras", cameras) +
        library("lights", lights) + library("images", images_) + library("materials", materials_) +
        library("effects", effects_) + library("geometries", geometries) +
        library("controllers", controllers_) + library("nodes", shared) +
        library("visual_scenes", scene) +
        xml("scene", "", xml("instance_visual_scene", attribute("url", "#" + scene_id), "")) +
        "</COLLADA>";
    Diagnostics quiet;
    std::optional<collada::Document> document =
        collada::read_document_text(path_, std::move(text), quiet);
    if (document && document->whole())
        result_.text = collada::write(*document, quiet.files, collada::Layout::Lines);
    else  // what the reader says is what is wrong with it: nested too deep
        collada::read_document_text(path_, std::string(quiet.files.text(0)), diagnostics_);
    return std::move(result_);
}

ColladaExport export_collada(const SceneDescription& description, const std::string& path,
                             Diagnostics& diagnostics) {
    return ColladaExporter(description, path, diagnostics).run();
}

}  // namespace kinora
