// collada/validate/lint_links.cpp: every link of the document leads to an element of the right
// kind; links into other documents.
#include <set>

#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

// A link: the URI in an attribute, or in the text (attribute ""). What extract resolves too is
// resolved with the same kinds, so that the findings are the same ones.
struct LinkRow {
    std::string_view element, attribute;
    void (*resolve)(Extraction& x, Link link, std::string_view attribute);
};
#define LINK_ROW(element, attribute, ...)                                      \
    LinkRow {                                                                  \
        element, attribute, [](Extraction& x, Link link, std::string_view a) { \
            resolve(x, link, a, {__VA_ARGS__});                                \
        }                                                                      \
    }
constexpr LinkRow kLinks[] = {
    LINK_ROW("instance_animation", "url", "animation"),
    LINK_ROW("instance_articulated_system", "url", "articulated_system"),
    LINK_ROW("instance_camera", "url", "camera"),
    LINK_ROW("instance_controller", "url", "controller"),
    LINK_ROW("instance_effect", "url", "effect"),
    LINK_ROW("instance_force_field", "url", "force_field"),
    LINK_ROW("instance_formula", "url", "formula"),
    LINK_ROW("instance_geometry", "url", "geometry"),
    LINK_ROW("instance_image", "url", "image"),
    LINK_ROW("instance_joint", "url", "joint"),
    LINK_ROW("instance_kinematics_model", "url", "kinematics_model"),
    LINK_ROW("instance_kinematics_scene", "url", "kinematics_scene"),
    LINK_ROW("instance_light", "url", "light"),
    LINK_ROW("instance_material", "target", "material"),
    LINK_ROW("instance_material", "url", "material"),  // of <render>
    LINK_ROW("instance_node", "url", "node"),
    LINK_ROW("instance_node", "proxy", "node"),
    LINK_ROW("instance_physics_material", "url", "physics_material"),
    LINK_ROW("instance_physics_model", "url", "physics_model"),
    LINK_ROW("instance_physics_model", "parent", "node"),
    LINK_ROW("instance_physics_scene", "url", "physics_scene"),
    LINK_ROW("instance_visual_scene", "url", "visual_scene"),
    LINK_ROW("channel", "source", "sampler"),
    LINK_ROW("skin", "source", "geometry", "controller"),
    LINK_ROW("morph", "source", "geometry", "controller"),
    LINK_ROW("convex_mesh", "convex_hull_of", "geometry"),
    LINK_ROW("render", "camera_node", "node"),
    LINK_ROW("skeleton", "", "node", "visual_scene"),
    LINK_ROW("accessor", "source", "float_array", "int_array", "bool_array", "Name_array",
             "IDREF_array", "SIDREF_array", "token_array"),
    LINK_ROW("csymbol", "definitionURL", "formula"),
};
#undef LINK_ROW

// The text or attribute without "", or nothing: absence is the element table's affair.
std::string_view link_text(const Element& element, std::string_view attribute) {
    return trim(attribute.empty() ? element.text : element.value(attribute));
}

// The first link into each other document.
class ExternalFiles {
  public:
    explicit ExternalFiles(Lint& lint) : lint_(lint) {}
    void see(const Element& element, std::string_view attribute, std::string_view url) {
        size_t hash = url.find('#');
        if (hash == 0 || hash == url.npos || !seen_.insert(url.substr(0, hash)).second) return;
        Location where = attribute.empty() ? lint_.document.text_location(element)
                                           : lint_.where(element, attribute);
        lint_.diag.report(Code::PORT_EXTERNAL, where, url);
    }

  private:
    Lint& lint_;
    std::set<std::string_view> seen_;
};

void check_row(Lint& lint, const LinkRow& row, ExternalFiles& files) {
    for (const Element* element : lint.named(row.element)) {
        std::string_view url = link_text(*element, row.attribute);
        if (url.empty()) continue;
        // MathML's own symbols are named by web addresses.
        if (row.element == "csymbol" && !url.starts_with('#')) continue;
        files.see(*element, row.attribute, url);
        row.resolve(lint.x, {0, element}, row.attribute);
    }
}

bool in_brep(const Element& element) {
    for (const Element* e = element.parent; e; e = e->parent)
        if (e->name == "brep") return true;
    return false;
}

// <input source>: of VERTEX the <vertices>, of all others a <source>; in <brep> also what its
// elements are made of.
void check_inputs(Lint& lint) {
    for (const Element* input : lint.named("input")) {
        if (input->value("source").empty()) continue;
        if (in_brep(*input))
            resolve(lint.x, {0, input}, "source",
                    {"source", "vertices", "edges", "wires", "faces", "shells", "pcurves"});
        else if (input->value("semantic") == "VERTEX")
            resolve(lint.x, {0, input}, "source", {"vertices"});
        else
            resolve(lint.x, {0, input}, "source", {"source"});
    }
}

void check_idref(Lint& lint, std::string_view id, Location where, std::string_view kind) {
    const Element* found = lint.document.find(id);
    if (!found && !lint.document.whole()) return;  // an error may have cut the target off
    if (!found)
        lint.diag.report(Code::LINK_UNRESOLVED, where, id, kind);
    else if (kind != "element" && !find_kind(lint.document, id, {kind}))
        lint.diag.report(Code::LINK_WRONG_TYPE, where, id, found->name, kind);
}

// 1.4: <surface><init_from> is the id of an image, mip and face variants likewise.
void check_surfaces(Lint& lint) {
    for (const Element* surface : lint.named("surface")) {
        for (const Element& child : surface->children()) {
            if (child.name != "init_from") continue;
            std::string_view id = trim(child.text);
            if (!id.empty()) check_idref(lint, id, lint.document.text_location(child), "image");
        }
    }
}

// Ids in an array. Of a skin's joints and a morph's targets the reader speaks.
void check_idref_arrays(Lint& lint) {
    for (const Element* array : lint.named("IDREF_array")) {
        const Element* owner = array->parent ? array->parent->parent : nullptr;
        if (!owner || owner->name == "skin" || owner->name == "morph") continue;
        for (std::string_view word : split_words(array->text)) {
            size_t begin = size_t(word.data() - array->text.data());
            check_idref(lint, word, lint.document.text_location(*array, begin, begin + word.size()),
                        "element");
        }
    }
}

}  // namespace

void lint_links(Lint& lint) {
    ExternalFiles files(lint);
    for (const LinkRow& row : kLinks) check_row(lint, row, files);
    check_inputs(lint);
    check_surfaces(lint);
    check_idref_arrays(lint);
}

}  // namespace kinora::collada
