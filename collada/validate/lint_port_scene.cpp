// collada/validate/lint_port_scene.cpp: units, cameras, nodes, materials: what other importers
// lose.
#include <set>

#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

void check_document(Lint& lint) {
    const Element& root = lint.document.root();
    if (lint.document.version() != Version::V1_4_1)
        lint.diag.report(Code::PORT_VERSION, lint.where(root, "version"), root.value("version"));
    const Element* asset = root.child("asset");
    const Element* unit = asset ? asset->child("unit") : nullptr;
    if (unit && lint.scene.asset.meter != 1.0)
        lint.diag.report(Code::PORT_UNIT, lint.where(*unit), lint.scene.asset.meter);
    const Element* up_axis = asset ? asset->child("up_axis") : nullptr;
    if (up_axis && lint.scene.asset.up_axis == UpAxis::X)
        lint.diag.report(Code::PORT_UP_AXIS, lint.where(*up_axis));
}

void check_cameras(Lint& lint) {
    for (const Element* lens : lint.named("perspective"))
        if (lens->child("xfov") && !lens->child("yfov"))
            lint.diag.report(Code::PORT_CAMERA, lint.where(*lens), "<xfov> without <yfov>");
    for (const Element* lens : lint.named("orthographic"))
        lint.diag.report(Code::PORT_CAMERA, lint.where(*lens), "an orthographic camera");
}

void check_nodes(Lint& lint) {
    auto skews = lint.named("skew");
    if (!skews.empty())
        lint.diag.report(Code::PORT_SKEW, lint.where(*skews.front()), skews.front()->name);
}

// What makers put into <extra> to say how a surface is drawn; once each and maker.
void check_extras(Lint& lint) {
    std::set<std::pair<std::string_view, std::string_view>> seen;
    for (const Element* technique : lint.named("technique")) {
        std::string_view profile = technique->value("profile");
        if (profile.empty() || technique->parent->name != "extra") continue;
        for (const Element& child : technique->children()) {
            bool drawn = child.name == "double_sided" || child.name == "bump";
            if (drawn && seen.emplace(child.name, profile).second)
                lint.diag.report(Code::PORT_EXTRA, lint.where(child), child.name, profile);
        }
    }
}

void check_morphs(Lint& lint) {
    for (const Element* morph : lint.named("morph"))
        lint.diag.report(Code::PORT_MORPH, lint.where(*morph), "a morph");
    for (const Skin& skin : lint.scene.skins)
        if (skin.morph != kNone && skin.where.file == lint.document.file())
            lint.diag.report(Code::PORT_MORPH, skin.where, "a skin on a morph");
}

}  // namespace

void lint_port_scene(Lint& lint) {
    check_document(lint);
    check_cameras(lint);
    check_nodes(lint);
    check_extras(lint);
    check_morphs(lint);
}

}  // namespace kinora::collada
