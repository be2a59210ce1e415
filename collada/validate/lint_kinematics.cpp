// collada/validate/lint_kinematics.cpp: joints, axes and what binds a kinematics scene to nodes
// (1.5).
#include <cmath>
#include <unordered_set>

#include "collada/document/element_numbers_p.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

// Where a SIDREF leads: id/sid/sid, "./sid", or a sid of what stands around it. Instances and
// parameters on the way are followed. `elsewhere`: into another document, which is not looked at.
struct Reach {
    const Element* element = nullptr;
    bool elsewhere = false;
};

class SidPaths {
  public:
    explicit SidPaths(Lint& lint) : document_(lint.document) {
        for (const Element* param : lint.named("newparam")) declared_.insert(param->value("sid"));
    }
    bool declares(std::string_view param) const { return declared_.count(param) > 0; }
    Reach find(const Element& from, std::string_view path, int depth = 0);

  private:
    using Sids = std::unordered_map<std::string_view, const Element*>;
    const Sids& sids_below(const Element& scope);
    Reach first_step(const Element& from, std::string_view name);
    Reach step(const Element& scope, std::string_view sid, int depth);
    Reach follow(const Element& element, int depth);

    const Document& document_;
    std::unordered_map<const Element*, Sids> sids_;
    std::unordered_set<std::string_view> declared_;  // sids of <newparam>s
    int steps_ = 1'000'000;  // instances may lead to one another in very many ways
};

const SidPaths::Sids& SidPaths::sids_below(const Element& scope) {
    auto [at, fresh] = sids_.try_emplace(&scope);
    if (!fresh) return at->second;
    std::vector<const Element*> queue{&scope};
    for (size_t i = 0; i < queue.size(); ++i)  // breadth first, as the specification asks
        for (const Element& child : queue[i]->children()) {
            if (child.attribute("sid")) at->second.emplace(child.value("sid"), &child);
            queue.push_back(&child);
        }
    return at->second;
}

Reach SidPaths::first_step(const Element& from, std::string_view name) {
    if (name == ".") return {from.parent};
    if (const Element* element = document_.find(name)) return {element};
    const Element* item = &from;  // of a library, or <scene>
    while (item->parent && item->parent != &document_.root() &&
           !item->parent->name.starts_with("library_"))
        item = item->parent;
    auto found = sids_below(*item).find(name);
    if (found != sids_below(*item).end()) return {found->second};
    return {};
}

// What an instance or a parameter stands for.
Reach SidPaths::follow(const Element& element, int depth) {
    if (const Element* sidref = element.child("SIDREF"); sidref && element.name != "axis_info")
        return find(*sidref, trim(sidref->text), depth + 1);
    std::string_view url = trim(element.value("url"));
    size_t hash = url.find('#');
    if (hash == url.npos) return {};
    if (hash > 0) return {nullptr, true};
    return {document_.find(url.substr(1))};
}

Reach SidPaths::step(const Element& scope, std::string_view sid, int depth) {
    auto found = sids_below(scope).find(sid);
    if (found != sids_below(scope).end()) return {found->second};
    if (depth > 16) return {};
    if (--steps_ < 0) return {nullptr, true};  // nothing is said then
    Reach next = follow(scope, depth);
    if (next.element && next.element != &scope) return step(*next.element, sid, depth + 1);
    if (next.elsewhere) return next;
    for (const Element& child : scope.children()) {  // a scene's instances need not have sids
        if (!child.name.starts_with("instance_")) continue;
        Reach inside = follow(child, depth);
        if (inside.element && inside.element != &scope)
            inside = step(*inside.element, sid, depth + 1);
        if (inside.element || inside.elsewhere) return inside;
    }
    return {};
}

Reach SidPaths::find(const Element& from, std::string_view path, int depth) {
    if (depth > 16) return {};
    if (path.starts_with('#')) path.remove_prefix(1);
    size_t slash = path.find('/');
    Reach at = first_step(from, path.substr(0, slash));
    for (int steps = 0; at.element && slash != path.npos && steps < 64; ++steps) {
        path.remove_prefix(slash + 1);
        slash = path.find('/');
        at = step(*at.element, path.substr(0, slash), depth);
    }
    return at;
}

bool leads_nowhere(SidPaths& paths, const Element& from, std::string_view path) {
    path = trim(path);
    if (path.empty()) return false;
    Reach reach = paths.find(from, path);
    if (reach.element || reach.elsewhere) return false;
    size_t member = path.find_last_of(".(");  // rotateX.ANGLE, rotateX(3)
    if (member == path.npos || member == 0) return true;
    reach = paths.find(from, path.substr(0, path.find('(')));
    if (!reach.element) reach = paths.find(from, path.substr(0, member));
    return !reach.element && !reach.elsewhere;
}

void check_attachments(Lint& lint, SidPaths& paths) {
    constexpr std::string_view kJoints[] = {"joint",    "instance_joint", "prismatic",
                                            "revolute", "axis",           "newparam"};
    for (std::string_view name : {"attachment_full", "attachment_start", "attachment_end"})
        for (const Element* attachment : lint.named(name)) {
            const Attribute* joint = attachment->attribute("joint");
            if (!joint) continue;
            Reach reach = paths.find(*attachment, trim(joint->value));
            bool fits = reach.elsewhere;
            for (std::string_view kind : kJoints)
                fits = fits || (reach.element && reach.element->name == kind);
            if (!fits)
                lint.diag.report(Code::KIN_JOINT, lint.where(*attachment, "joint"), joint->value);
        }
}

void check_axes(Lint& lint, SidPaths& paths) {
    for (std::string_view name : {"prismatic", "revolute"})
        for (const Element* joint : lint.named(name)) {
            const Element* axis = joint->child("axis");
            if (!axis) {
                lint.diag.report(Code::KIN_AXIS, lint.where(*joint), name, "it has no <axis>");
                continue;
            }
            Diagnostics unheard;
            std::vector<double> v = read_doubles(lint.document, *axis, unheard);
            bool zero = v.size() >= 3 && v[0] == 0 && v[1] == 0 && v[2] == 0;
            if (zero)
                lint.diag.report(Code::KIN_AXIS, lint.where(*axis), name,
                                 "its axis has no direction");
        }
    for (const Element* info : lint.named("axis_info"))
        if (leads_nowhere(paths, *info, info->value("axis")))
            lint.diag.report(Code::KIN_AXIS, lint.where(*info, "axis"), info->name,
                             fmt::format("'{}' names no axis", info->value("axis")));
}

bool number_of(const Element* limit, double& value) {
    if (!limit) return false;
    const Element* wrapped = limit->child("float");
    return parse_double(wrapped ? wrapped->text : limit->text, value);
}

void check_axis_limits(Lint& lint) {
    for (const Element* limits : lint.named("limits")) {
        std::string_view owner = limits->parent->name;
        if (owner != "prismatic" && owner != "revolute" && owner != "axis_info") continue;
        double low = 0, high = 0;
        if (number_of(limits->child("min"), low) && number_of(limits->child("max"), high) &&
            low > high)
            lint.diag.report(Code::KIN_LIMIT, lint.where(*limits), owner, low, high);
    }
}

// A SIDREF must lead somewhere, a <param> must be declared somewhere.
void check_reference(Lint& lint, SidPaths& paths, const Element& owner, const Element& bind) {
    if (const Element* sidref = owner.child("SIDREF"))
        if (leads_nowhere(paths, *sidref, sidref->text))
            lint.diag.report(Code::KIN_TARGET, lint.document.text_location(*sidref), "SIDREF",
                             trim(sidref->text), bind.name);
    const Element* param = owner.child("param");
    std::string_view name = param ? trim(param->text) : std::string_view{};
    if (name.empty() || paths.declares(name)) return;
    if (leads_nowhere(paths, *param, name))
        lint.diag.report(Code::KIN_TARGET, lint.document.text_location(*param), "param", name,
                         bind.name);
}

void check_binds(Lint& lint, SidPaths& paths) {
    struct {
        std::string_view element, attribute;
    } rows[] = {{"bind_joint_axis", "target"}, {"bind_kinematics_model", "node"}};
    for (auto& row : rows)
        for (const Element* bind : lint.named(row.element)) {
            std::string_view target = bind->value(row.attribute);
            if (leads_nowhere(paths, *bind, target))
                lint.diag.report(Code::KIN_TARGET, lint.where(*bind, row.attribute), row.attribute,
                                 target, bind->name);
            const Element* axis = bind->child("axis");
            check_reference(lint, paths, axis ? *axis : *bind, *bind);
        }
}

}  // namespace

void lint_kinematics(Lint& lint) {
    SidPaths paths(lint);
    check_attachments(lint, paths);
    check_axes(lint, paths);
    check_axis_limits(lint);
    check_binds(lint, paths);
}

}  // namespace kinora::collada
