// collada/validate/lint_port_mesh.cpp: meshes that other importers cut or colour in their own way.
// Each habit is reported where it first occurs.
#include <set>

#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

void check_kinds(Lint& lint) {
    auto holed = lint.named("ph");
    if (!holed.empty()) lint.diag.report(Code::PORT_HOLES, lint.where(*holed.front()));
    for (std::string_view name : {"tristrips", "trifans"}) {
        auto strips = lint.named(name);
        if (!strips.empty()) lint.diag.report(Code::PORT_STRIPS, lint.where(*strips.front()), name);
    }
}

void check_vertices(Lint& lint) {
    std::set<std::string_view> seen;
    for (const Element* vertices : lint.named("vertices"))
        for (const Element& input : vertices->children()) {
            std::string_view semantic = input.value("semantic");
            if (input.name == "input" && semantic != "POSITION" && seen.insert(semantic).second)
                lint.diag.report(Code::PORT_VERTEX_INPUT, lint.where(input), semantic);
        }
}

}  // namespace

void lint_port_mesh(Lint& lint) {
    check_kinds(lint);
    check_vertices(lint);
}

}  // namespace kinora::collada
