// collada/validate/lint_physics.cpp: rigid bodies, constraints and shapes of physics models and
// scenes.
#include <cmath>
#include <set>
#include <unordered_set>

#include "collada/document/element_numbers_p.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

std::vector<double> numbers_of(Lint& lint, const Element& element) {
    Diagnostics unheard;  // what is no number is the schema's to say
    return read_doubles(lint.document, element, unheard);
}

// What a model holds under each kind of element and each sid (exporters: or id), or a model
// instanced in it.
class Models {
  public:
    explicit Models(Lint& lint) : lint_(lint) {}

    bool has(Link model, std::string_view kind, std::string_view name) {
        std::vector<const Model*> todo{&read(model)};
        std::unordered_set<const Model*> seen{todo[0]};
        while (!todo.empty()) {
            const Model& at = *todo.back();
            todo.pop_back();
            // Models may lead to one another in very many ways: then nothing is said.
            if (--steps_ < 0 || at.members.count({kind, name})) return true;
            for (Link nested : at.nested)
                if (const Model* next = &read(nested); seen.insert(next).second)
                    todo.push_back(next);
        }
        return false;
    }

  private:
    struct Model {
        std::set<std::pair<std::string_view, std::string_view>> members;
        std::vector<Link> nested;
    };
    const Model& read(Link link) {
        auto [at, fresh] = models_.try_emplace(link.element);
        Model& model = at->second;
        if (!fresh) return model;
        for (const Element& child : link.element->children()) {
            for (std::string_view key : {"sid", "id"})
                if (child.attribute(key)) model.members.insert({child.name, child.value(key)});
            if (child.name != "instance_physics_model") continue;
            if (Link nested = resolve(lint_.x, {link.doc, &child}, "url", {"physics_model"}))
                model.nested.push_back(nested);
        }
        return model;
    }

    Lint& lint_;
    std::unordered_map<const Element*, Model> models_;
    int steps_ = 1'000'000;
};

// body= and constraint= name parts of the model that the parent instances.
void check_member(Lint& lint, Models& models, const Element& instance, std::string_view attribute,
                  std::string_view kind, const FindingInfo& code) {
    const Element* parent = instance.parent;
    const Attribute* name = instance.attribute(attribute);
    if (!name || !parent || parent->name != "instance_physics_model") return;
    Link model = resolve(lint.x, {0, parent}, "url", {"physics_model"});
    if (model && !models.has(model, kind, trim(name->value)))
        lint.diag.report(code, lint.where(instance, attribute), name->value,
                         model.element->value("id"));
}

bool in_other_file(std::string_view uri) {
    size_t hash = uri.find('#');
    return hash != uri.npos && hash > 0;
}

void check_target(Lint& lint, const Element& instance) {
    const Attribute* target = instance.attribute("target");
    if (!target || in_other_file(target->value)) return;
    std::string_view id = trim(target->value);
    if (id.starts_with('#')) id.remove_prefix(1);
    if (!find_kind(lint.document, id.substr(0, id.find('/')), {"node"}))
        lint.diag.report(Code::PHYS_TARGET, lint.where(instance, "target"), target->value);
}

// rigid_body= is a URI by the specification; sids within the model are written as well.
void check_attachment(Lint& lint, Models& models, const Element& attachment) {
    const Attribute* body = attachment.attribute("rigid_body");
    std::string_view name = body ? trim(body->value) : std::string_view{};
    if (name.empty() || in_other_file(name)) return;
    if (name.starts_with('#')) name.remove_prefix(1);
    if (find_kind(lint.document, name, {"rigid_body", "node"})) return;
    std::string_view last = name.substr(name.find_last_of('/') + 1);
    const Element* model = attachment.parent;
    while (model && model->name != "physics_model") model = model->parent;
    if (model && models.has({0, model}, "rigid_body", last)) return;
    lint.diag.report(Code::PHYS_ATTACHMENT, lint.where(attachment, "rigid_body"), attachment.name,
                     body->value);
}

// A number below its least makes no sense; `zero` says whether 0 does.
struct SizeRow {
    std::string_view shape, size;
    bool zero;
};
constexpr SizeRow kSizes[] = {
    {"box", "half_extents", false},        {"sphere", "radius", false},
    {"cylinder", "height", false},         {"cylinder", "radius", false},
    {"capsule", "height", true},           {"capsule", "radius", false},
    {"tapered_cylinder", "height", false}, {"tapered_cylinder", "radius1", true},
    {"tapered_cylinder", "radius2", true}, {"tapered_capsule", "height", true},
    {"tapered_capsule", "radius1", true},  {"tapered_capsule", "radius2", true}};

void check_sizes(Lint& lint) {
    for (const SizeRow& row : kSizes)
        for (const Element* shape : lint.named(row.shape)) {
            const Element* size = shape->child(row.size);
            if (!size || shape->parent->name != "shape") continue;
            for (double v : numbers_of(lint, *size))
                if (!(v > 0 || (row.zero && v == 0))) {
                    lint.diag.report(Code::PHYS_SHAPE, lint.where(*size), row.shape,
                                     fmt::format("has a {} of {}", row.size, v));
                    break;
                }
        }
    for (const Element* equation : lint.named("equation")) {
        std::vector<double> v = numbers_of(lint, *equation);
        if (equation->parent->name == "plane" && v.size() >= 3 && v[0] == 0 && v[1] == 0 &&
            v[2] == 0)
            lint.diag.report(Code::PHYS_SHAPE, lint.where(*equation), "plane",
                             "has a normal without direction");
    }
    for (const Element* body : lint.named("rigid_body")) {
        const Element* common = body->child("technique_common");
        if (common && !common->child("shape"))
            lint.diag.report(Code::PHYS_SHAPE, lint.where(*body), body->name, "has no <shape>");
    }
}

void check_materials(Lint& lint) {
    for (const Element* material : lint.named("physics_material"))
        if (const Element* common = material->child("technique_common"))
            for (const Element& value : common->children())
                for (double v : numbers_of(lint, value)) {
                    bool restitution = value.name == "restitution";
                    bool known = restitution || value.name.ends_with("_friction");
                    if (known && (!(v >= 0) || (restitution && v > 1)))
                        lint.diag.report(Code::PHYS_MATERIAL, lint.where(value), value.name, v);
                }
}

void check_masses(Lint& lint) {
    for (std::string_view name : {"mass", "density", "inertia"})
        for (const Element* value : lint.named(name)) {
            const Element* owner = value->parent;
            if (owner->name != "shape" && owner->name != "technique_common") continue;
            const Element* dynamic = owner->child("dynamic");
            bool moved = dynamic && parse_bool(dynamic->text).value_or(false);
            for (double v : numbers_of(lint, *value))
                if (!(v >= 0) || (v == 0 && name == "mass" && moved)) {
                    lint.diag.report(Code::PHYS_MASS, lint.where(*value), name, v);
                    break;
                }
        }
}

void check_constraint_limits(Lint& lint) {
    for (const Element* limits : lint.named("limits"))
        for (const Element& axis : limits->children()) {
            const Element *min = axis.child("min"), *max = axis.child("max");
            if (!min || !max) continue;
            std::vector<double> low = numbers_of(lint, *min), high = numbers_of(lint, *max);
            for (size_t i = 0; i < std::min(low.size(), high.size()); ++i)
                if (low[i] > high[i]) {
                    lint.diag.report(Code::PHYS_LIMIT, lint.where(*min), axis.name, low[i],
                                     high[i]);
                    break;
                }
        }
}

}  // namespace

void lint_physics(Lint& lint) {
    Models models(lint);
    for (const Element* instance : lint.named("instance_rigid_body")) {
        check_member(lint, models, *instance, "body", "rigid_body", Code::PHYS_RIGID_BODY);
        check_target(lint, *instance);
    }
    for (const Element* instance : lint.named("instance_rigid_constraint"))
        check_member(lint, models, *instance, "constraint", "rigid_constraint",
                     Code::PHYS_CONSTRAINT);
    for (std::string_view name : {"ref_attachment", "attachment"})
        for (const Element* attachment : lint.named(name))
            check_attachment(lint, models, *attachment);
    check_sizes(lint);
    check_materials(lint);
    check_masses(lint);
    check_constraint_limits(lint);
}

}  // namespace kinora::collada
