// collada/validate/lint_inputs.cpp: several sets of one semantic in one primitive element.
#include <map>
#include <set>

#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

// Several sets of a semantic, which importers mix up. Each semantic gets one finding.
void check_sets(Lint& lint, const Element& primitive, std::set<std::string_view>& told) {
    std::map<std::string_view, std::set<std::string_view>> sets;
    for (const Element& input : primitive.children())
        if (input.name == "input") sets[input.value("semantic")].insert(input.value("set"));
    for (auto& [semantic, known] : sets)
        if (known.size() > 1 && told.insert(semantic).second)
            lint.diag.report(Code::PORT_MULTI_SET, lint.where(primitive), known.size(), semantic);
}

}  // namespace

void lint_inputs(Lint& lint) {
    std::set<std::string_view> told;
    for (std::string_view name : {"triangles", "polylist", "polygons", "tristrips", "trifans"})
        for (const Element* primitive : lint.named(name)) check_sets(lint, *primitive, told);
}

}  // namespace kinora::collada
