// collada/extract/everything.cpp: what <scene> does not reach, read for its findings.
//
// The items go to the ends of the same lists, after all that the picture uses: its indices and
// values stay as they are, and further checks (profile_RSL) find the rest behind them. Channels
// stay in document order, so that those of unreached items stand between the others.
#include "collada/extract/extract_p.h"

namespace kinora::collada {

namespace {

void read_controller(Extraction& x, Link link) {
    if (link.element->child("skin"))
        skin_index(x, link);
    else if (link.element->child("morph"))
        morph_index(x, link);
}

// Other kinds of geometry (convex_mesh for physics) are no fault where no picture shows them.
void read_geometry(Extraction& x, Link link) {
    if (link.element->child("mesh")) geometry_index(x, link);
}

void read_unshown_scene(Extraction& x, Link link) {
    for (const Element& child : link.element->children())
        if (child.name == "node") node_index(x, {link.doc, &child});
    rsl_extra_materials(x, link);
}

struct LibraryRow {
    std::string_view library, item;
    void (*read)(Extraction&, Link);
};
constexpr LibraryRow kLibraries[] = {
    {"library_visual_scenes", "visual_scene", read_unshown_scene},
    {"library_nodes", "node", [](Extraction& x, Link link) { node_index(x, link); }},
    {"library_geometries", "geometry", read_geometry},
    {"library_controllers", "controller", read_controller},
    {"library_cameras", "camera", [](Extraction& x, Link link) { camera_index(x, link); }},
    {"library_lights", "light", [](Extraction& x, Link link) { light_index(x, link); }},
    {"library_materials", "material", [](Extraction& x, Link link) { material_index(x, link); }},
    {"library_effects", "effect", [](Extraction& x, Link link) { effect_index(x, link); }},
    {"library_images", "image", [](Extraction& x, Link link) { image_index(x, link); }},
};

}  // namespace

void read_everything(Extraction& x) {
    x.reached_nodes = uint32_t(x.scene.nodes.size());
    // Only of the root document: the others are validated by themselves.
    for (const Element& library : x.document(0).root().children())
        for (const LibraryRow& row : kLibraries) {
            if (row.library != library.name) continue;
            for (const Element& item : library.children())
                if (item.name == row.item) row.read(x, {0, &item});
        }
    read_pending_nodes(x);
}

}  // namespace kinora::collada
