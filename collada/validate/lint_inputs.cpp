// collada/validate/lint_inputs.cpp: several inputs of one semantic in one primitive element.
#include <map>
#include <set>

#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

// Inputs of one primitive element by semantic: sets that occur twice are a fault, several sets are
// what importers mix up.
class SetCheck {
  public:
    explicit SetCheck(Lint& lint) : lint_(lint) {}
    void run(const Element& primitive) {
        std::map<std::string_view, std::set<std::string_view>> sets;
        for (const Element& input : primitive.children()) {
            if (input.name != "input") continue;
            std::string_view semantic = input.value("semantic"), set = input.value("set");
            if (!sets[semantic].insert(set).second)
                lint_.diag.report(Code::PRIM_SET_TWICE, lint_.where(input), semantic,
                                  set.empty() ? "no set" : fmt::format("set {}", set));
        }
        for (auto& [semantic, known] : sets)
            if (known.size() > 1 && seen_.insert(semantic).second)
                lint_.diag.report(Code::PORT_MULTI_SET, lint_.where(primitive), known.size(),
                                  semantic);
    }

  private:
    Lint& lint_;
    std::set<std::string_view> seen_;
};

}  // namespace

void lint_inputs(Lint& lint) {
    SetCheck sets(lint);
    for (std::string_view name : {"triangles", "polylist", "polygons", "tristrips", "trifans"})
        for (const Element* primitive : lint.named(name)) sets.run(*primitive);
}

}  // namespace kinora::collada
