// collada/validate/lint_materials.cpp: the symbols of primitives against those that instances bind.
#include <algorithm>

#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

using Symbols = std::vector<std::string_view>;

bool is_primitive(std::string_view name) {
    constexpr std::string_view kPrimitives[] = {"triangles", "polylist", "polygons",  "tristrips",
                                                "trifans",   "lines",    "linestrips"};
    return std::find(std::begin(kPrimitives), std::end(kPrimitives), name) != std::end(kPrimitives);
}

// The symbols of a geometry's primitives, sorted, each once; once a geometry.
class SymbolTable {
  public:
    bool first_time(const Element& geometry) const { return !symbols_.count(&geometry); }
    const Symbols& of(const Element& geometry) {
        auto [at, fresh] = symbols_.try_emplace(&geometry);
        if (!fresh) return at->second;
        for (const Element& shape : geometry.children())
            for (const Element& child : shape.children())
                if (is_primitive(child.name)) at->second.push_back(child.value("material"));
        std::sort(at->second.begin(), at->second.end());
        at->second.erase(std::unique(at->second.begin(), at->second.end()), at->second.end());
        return at->second;
    }

  private:
    std::unordered_map<const Element*, Symbols> symbols_;
};

const Element* local(const Lint& lint, const Element& element, std::string_view attribute,
                     Kinds kinds) {
    std::string_view url = trim(element.value(attribute));
    return url.starts_with('#') ? find_kind(lint.document, url.substr(1), kinds) : nullptr;
}

// The geometry at the end of a chain of controllers; null if it is in another document.
const Element* shown_geometry(const Lint& lint, const Element& instance) {
    const Element* at = local(lint, instance, "url", {"geometry", "controller"});
    for (int links = 0; at && at->name == "controller" && links < 8; ++links) {
        const Element* deformer = at->child("skin");
        if (!deformer) deformer = at->child("morph");
        at = deformer ? local(lint, *deformer, "source", {"geometry", "controller"}) : nullptr;
    }
    return at && at->name == "geometry" ? at : nullptr;
}

// <brep> and <spline> have other primitives.
bool has_mesh(const Element& geometry) {
    return geometry.child("mesh") || geometry.child("convex_mesh");
}

// Primitives without a symbol beside an instance that binds materials are forgotten ones.
void check_no_symbol(Lint& lint, const Element& geometry) {
    const Element* mesh = geometry.child("mesh");
    if (!mesh) return;
    for (const Element& child : mesh->children())
        if (is_primitive(child.name) && child.value("material").empty())
            lint.diag.report(Code::MAT_NO_SYMBOL, lint.where(child), child.name);
}

void check_instance(Lint& lint, const Element& instance, SymbolTable& table) {
    const Element* bind = instance.child("bind_material");
    const Element* common = bind ? bind->child("technique_common") : nullptr;
    const Element* geometry = common ? shown_geometry(lint, instance) : nullptr;
    if (!geometry || !has_mesh(*geometry)) return;
    if (table.first_time(*geometry)) check_no_symbol(lint, *geometry);
    const Symbols& symbols = table.of(*geometry);
    for (const Element& material : common->children()) {
        std::string_view symbol = material.value("symbol");
        if (material.name != "instance_material" || symbol.empty()) continue;
        if (!std::binary_search(symbols.begin(), symbols.end(), symbol))
            lint.diag.report(Code::MAT_UNUSED_BIND, lint.where(material, "symbol"),
                             geometry->value("id"), symbol);
    }
}

}  // namespace

void lint_materials(Lint& lint) {
    SymbolTable table;
    for (std::string_view name : {"instance_geometry", "instance_controller"})
        for (const Element* instance : lint.named(name)) check_instance(lint, *instance, table);
}

}  // namespace kinora::collada
