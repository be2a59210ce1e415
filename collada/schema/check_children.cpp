// collada/schema/check_children.cpp: the children of an element against its content model, and what
// to say of those that do not fit.
#include "collada/schema/check_elements_p.h"

namespace kinora::collada {

namespace {

using Kind = Particle::Kind;

std::string child_name(const ContentModel::Position& position) {
    if (position.kind == Kind::Any) return "an element";
    return position.kind == Kind::Math ? "<math>" : "<" + std::string(position.name) + ">";
}

// "<a>", "one of <a>, <b>"
std::string one_of(const ContentModel& model, const std::vector<uint16_t>& next) {
    constexpr size_t kMost = 12;
    std::string out = next.size() > 1 ? "one of " : "";
    for (size_t i = 0; i < next.size() && i < kMost; ++i)
        out += (i ? ", " : "") + child_name(model.positions[next[i]]);
    return next.size() > kMost ? out + ", ..." : out;
}

bool has_child(const Element* from, std::string_view name) {
    for (; from; from = from->next)
        if (from->name == name) return true;
    return false;
}

size_t count_before(const Element& parent, const Element& child) {
    size_t n = 0;
    for (const Element* e = parent.first_child; e && e != &child; e = e->next)
        n += e->name == child.name;
    return n;
}

}  // namespace

void ElementChecker::check_children(const Element& element, const ElementType& type, bool kept) {
    const ContentModel& model = type.rules().content;
    uint16_t at = 0;
    for (const Element& child : element.children()) {
        uint16_t next = step(model, at, child);
        if (!next) {
            at = misplaced(element, type, at, child, kept);
            continue;
        }
        at = next;
        const ContentModel::Position& position = model.positions[at];
        if (position.type)
            check(child, *position.type, kept);
        else if (position.kind == Kind::Any)
            check_any(child, kept);
    }
    if (!model.positions[at].last) missing_children(element, type, at);
}

uint16_t ElementChecker::step(const ContentModel& model, uint16_t at, const Element& child) {
    if (foreign(child)) {
        if (uint16_t any = model.step(at, Kind::Any)) return any;
        bool math = child.name == "math" || child.name.ends_with(":math");
        return math ? model.step(at, Kind::Math) : uint16_t(0);
    }
    if (uint16_t next = model.step(at, child.name)) return next;
    return model.step(at, Kind::Any);
}

// Each look at the siblings takes as long as there are siblings.
bool ElementChecker::misplaced_often(const ElementType& type, const Element& child) {
    constexpr uint32_t kOften = 64;
    return ++misplaced_[{&type, child.name}] > kOften;
}

uint16_t ElementChecker::misplaced(const Element& element, const ElementType& type, uint16_t at,
                                   const Element& child, bool kept) {
    const ContentModel& model = type.rules().content;
    uint16_t position = foreign(child) ? uint16_t(0) : model.find(child.name);
    if (!position) {
        unknown_child(element, type, at, child, kept);
        return at;
    }
    std::vector<uint16_t> way = model.way(at, child.name);
    if (way.empty()) {
        disordered_child(element, type, child);
        check(child, *model.positions[position].type, kept);
        return at;
    }
    // What was jumped over is missing, or comes later and is then out of order.
    bool later = true, often = misplaced_often(type, child);
    for (size_t i = 0; i + 1 < way.size() && !often; ++i)
        later = later && has_child(child.next, model.positions[way[i]].name);
    if (!later && first(Code::SCHEMA_MIN_OCCURS, &type, child.name))
        diag_.report(Code::SCHEMA_MIN_OCCURS, document_.location(child), element.name,
                     one_of(model, model.missing(at, child.name)) + " before <" +
                         std::string(child.name) + ">");
    check(child, *model.positions[way.back()].type, kept);
    return way.back();
}

void ElementChecker::unknown_child(const Element& element, const ElementType& type, uint16_t at,
                                   const Element& child, bool kept) {
    const ElementType* other = type.row ? other_version().find(type.name) : nullptr;
    uint16_t position =
        other && !foreign(child) ? other->rules().content.find(child.name) : uint16_t(0);
    if (position) {
        if (first(Code::SCHEMA_VERSION, &type, child.name))
            diag_.report(Code::SCHEMA_VERSION, document_.location(child), child.name,
                         is_15(types_.version()) ? "1.5" : "1.4");
        return check(child, *other->rules().content.positions[position].type, kept);
    }
    const ContentModel& model = type.rules().content;
    if (foreign(child) || types_.has_element(child.name) ||
        other_version().has_element(child.name)) {
        if (!first(Code::SCHEMA_UNEXPECTED, &type, child.name)) return;
        Finding& finding = diag_.report(
            Code::SCHEMA_UNEXPECTED, document_.location(child), child.name, element.name,
            model.positions[at].next.empty()
                ? ""
                : ", expected " + one_of(model, model.positions[at].next));
        if (foreign(child) && child.name.find(':') == child.name.npos)
            finding.help =
                fmt::format("it is of the namespace '{}', not COLLADA's", namespaces_.of(child));
        return;
    }
    if (!first(Code::SCHEMA_UNKNOWN_ELEMENT, &type, child.name)) return;
    Finding& finding = diag_.report(Code::SCHEMA_UNKNOWN_ELEMENT, document_.location(child),
                                    child.name, element.name);
    std::string_view near = may_suggest() ? types_.nearest(child.name) : "";
    if (!near.empty()) finding.help = fmt::format("did you mean <{}>?", near);
}

// The child is known here, but nothing leads from where we are to it.
void ElementChecker::disordered_child(const Element& element, const ElementType& type,
                                      const Element& child) {
    const ContentModel& model = type.rules().content;
    uint16_t position = model.find(child.name);
    if (misplaced_often(type, child)) return;
    // The first sibling before it that could follow it: it stands too late.
    for (const Element* e = element.first_child; e && e != &child; e = e->next) {
        if (e->name == child.name || model.way(position, e->name).empty()) continue;
        if (first(Code::SCHEMA_ORDER, &type, child.name))
            diag_.report(Code::SCHEMA_ORDER, document_.location(child), child.name, e->name);
        return;
    }
    if (size_t before = count_before(element, child)) {
        if (!first(Code::SCHEMA_MAX_OCCURS, &type, child.name)) return;
        diag_.report(Code::SCHEMA_MAX_OCCURS, document_.location(child), child.name,
                     before == 1 ? std::string("once") : fmt::format("{} times", before),
                     element.name);
        return;
    }
    const Element* beside = element.first_child;
    while (beside->next && beside->next != &child) beside = beside->next;
    if (first(Code::SCHEMA_CHOICE, &type, child.name))
        diag_.report(Code::SCHEMA_CHOICE, document_.location(child), child.name, beside->name);
}

void ElementChecker::missing_children(const Element& element, const ElementType& type,
                                      uint16_t at) {
    if (document_.cut(element)) return;
    const ContentModel& model = type.rules().content;
    bool library = element.name.starts_with("library_");
    if (library && first(Code::SCHEMA_EMPTY_LIBRARY, &type, element.name))
        diag_.report(Code::SCHEMA_EMPTY_LIBRARY, document_.location(element), element.name);
    if (library || !first(Code::SCHEMA_MIN_OCCURS, &type, {})) return;
    std::vector<uint16_t> missing = model.missing(at, {});
    std::string what = one_of(model, missing);
    uint16_t only = missing.size() == 1 ? missing[0] : uint16_t(0);
    if (only && model.positions[only].name == model.positions[at].name) what = "another " + what;
    diag_.report(Code::SCHEMA_MIN_OCCURS, document_.location(element), element.name, what);
}

}  // namespace kinora::collada
