// collada/validate/lint_cycles.cpp: definitions that lead back to themselves. Cycles of
// instance_node are found where the node tree is read.
#include <algorithm>
#include <string>

#include "collada/document/uri.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

// The definitions of one kind and the links between them, followed depth first without recursion:
// a chain may be as long as the file.
class Definitions {
  public:
    explicit Definitions(Lint& lint) : lint_(lint) {}

    void add_link(Link from, Link to, Location where) {
        if (!from || !to) return;
        state_of(from).links.push_back({to.element, where});
        state_of(to);
    }
    void report_cycles() {
        for (const Element* start : order_) {
            if (states_[start].color == White) enter(start);
            while (!path_.empty()) step();
        }
    }

  private:
    enum Color : uint8_t { White, Gray, Black };
    struct State {
        Color color = White;
        uint32_t doc = 0;
        size_t next = 0;
        std::vector<std::pair<const Element*, Location>> links;
    };

    State& state_of(Link link) {
        auto [at, fresh] = states_.try_emplace(link.element);
        if (fresh) order_.push_back(link.element);
        at->second.doc = link.doc;
        return at->second;
    }
    void enter(const Element* element) {
        states_[element].color = Gray;
        path_.push_back(element);
    }
    void step() {
        State& s = states_[path_.back()];
        if (s.next == s.links.size()) {
            s.color = Black;
            path_.pop_back();
            return;
        }
        auto [to, where] = s.links[s.next++];
        Color color = states_[to].color;
        if (color == White) enter(to);
        if (color == Gray) report(to, where);
    }
    void report(const Element* to, Location where) {
        constexpr long kShown = 16;
        auto from = std::find(path_.begin(), path_.end(), to);
        bool several = std::any_of(
            from, path_.end(), [&](const Element* e) { return states_[e].doc != states_[to].doc; });
        std::string text;
        for (auto e = from; e != path_.end(); ++e) {
            if (e - from == kShown) {
                text += "... -> ";
                break;
            }
            text += label(**e, several) + " -> ";
        }
        lint_.diag.report(Code::LINK_CYCLE, where, text + label(*to, several));
    }
    // Where several documents take part, each definition says which is its own.
    std::string label(const Element& e, bool several) {
        std::string_view name = e.value(e.name == "newparam" ? "sid" : "id");
        if (several && !name.empty()) {
            const std::string& path = lint_.x.scene.documents[states_[&e].doc].path;
            return fmt::format("'{}#{}'", path.substr(path.rfind('/') + 1), name);
        }
        return name.empty() ? "<" + std::string(e.name) + ">" : "'" + std::string(name) + "'";
    }

    Lint& lint_;
    std::unordered_map<const Element*, State> states_;
    std::vector<const Element*> order_;
    std::vector<const Element*> path_;
};

const Element* enclosing(const Element& element, std::string_view name) {
    const Element* e = element.parent;
    while (e && e->name != name) e = e->parent;
    return e;
}

// Where `link` stands inside a `definition`, its attribute may name another one.
struct CycleRow {
    std::string_view definition, link, attribute;
};
constexpr CycleRow kCycles[] = {
    {"controller", "skin", "source"},
    {"controller", "morph", "source"},
    {"physics_model", "instance_physics_model", "url"},
    {"articulated_system", "instance_articulated_system", "url"},
    {"formula", "csymbol", "definitionURL"},
    {"formula", "instance_formula", "url"},
};

void add_link(Lint& lint, const CycleRow& row, Link link, Definitions& graph) {
    std::string_view url = trim(link.element->value(row.attribute));
    size_t hash = url.find('#');
    const Element* from = enclosing(*link.element, row.definition);
    if (!from || hash == url.npos) return;
    uint32_t doc = hash == 0 ? link.doc : lint.x.documents.find(link.doc, url.substr(0, hash));
    if (doc == kNone) return;
    const Element* to = find_kind(lint.x.document(doc), url.substr(hash + 1), {row.definition});
    graph.add_link({link.doc, from}, {doc, to}, lint.x.where(link, row.attribute));
}

void add_links(Lint& lint, const CycleRow& row, Definitions& graph) {
    for (const Element* link : lint.named(row.link)) add_link(lint, row, {0, link}, graph);
}

// Of a document that links led to.
void add_linked(Lint& lint, Link at, Definitions& graph) {
    for (const CycleRow& row : kCycles)
        if (at.element->name == row.link) add_link(lint, row, at, graph);
    for (const Element& child : at.element->children()) add_linked(lint, {at.doc, &child}, graph);
}

// The <newparam>s by the element they stand in and their sid: looked up inside out.
class ParamScopes {
  public:
    explicit ParamScopes(const Lint& lint) {
        for (const Element* param : lint.named("newparam"))
            scopes_[param->parent].try_emplace(param->value("sid"), param);
    }
    const Element* find(const Element& from, std::string_view sid) const {
        for (const Element* e = from.parent; e; e = e->parent) {
            auto scope = scopes_.find(e);
            if (scope != scopes_.end()) {
                auto param = scope->second.find(sid);
                if (param != scope->second.end()) return param->second;
            }
            if (e->name == "effect") break;
        }
        return nullptr;
    }

  private:
    std::unordered_map<const Element*, std::unordered_map<std::string_view, const Element*>>
        scopes_;
};

// <newparam> whose sampler takes its <source> from another one: the sid in the elements around it.
void add_params(Lint& lint, Definitions& graph) {
    ParamScopes scopes(lint);
    for (const Element* param : lint.named("newparam")) {
        for (const Element& value : param->children()) {
            const Element* source = value.child("source");
            if (!source || !value.name.starts_with("sampler")) continue;
            if (const Element* to = scopes.find(*source, trim(source->text)))
                graph.add_link({0, param}, {0, to}, lint.document.text_location(*source));
        }
    }
}

}  // namespace

void lint_cycles(Lint& lint) {
    // One graph: links lead from a definition to one of its own kind.
    Definitions graph(lint);
    for (const CycleRow& row : kCycles) add_links(lint, row, graph);
    for (uint32_t doc = 1; doc < lint.x.documents.size(); ++doc)
        add_linked(lint, {doc, &lint.x.document(doc).root()}, graph);
    add_params(lint, graph);
    graph.report_cycles();
}

}  // namespace kinora::collada
