// rsl/objects/expand_names.cpp: what the names in rewritten code mean.
#include "rsl/objects/expand.h"

#include <algorithm>

#include "rsl/text/did_you_mean.h"

namespace kinora::rsl {

const Symbol* ObjectExpander::find(std::string_view name, std::string* prefix) const {
    for (size_t i = scopes_.size(); i-- > 0;) {
        const Scope& scope = scopes_[i];
        bool placed = !scope.prefix.empty() && name.starts_with(scope.prefix);
        std::string_view written = placed ? name.substr(scope.prefix.size()) : name;
        for (size_t k = scope.symbols.size(); k-- > 0;) {
            if (scope.symbols[k]->name != written) continue;
            if (prefix && !placed) *prefix = scope.prefix;
            return scope.symbols[k];
        }
    }
    return nullptr;
}

// With the prefix of what declares it.
std::string_view ObjectExpander::placed(std::string_view name) const {
    std::string prefix;
    find(first_name(name), &prefix);
    return prefix.empty() ? name : ast_.arena.copy(prefix + std::string(name));
}

// A member named alone in a method; null where something nearer has the name.
const Symbol* ObjectExpander::member_of_object(std::string_view name) const {
    return owner_ && !find(name) ? find_member(*owner_, name) : nullptr;
}

bool ObjectExpander::is_local_function(std::string_view name) const {
    for (const Scope& scope : scopes_)
        if (std::find(scope.functions.begin(), scope.functions.end(), name) !=
            scope.functions.end())
            return true;
    return false;
}

void ObjectExpander::want(std::string_view name, const StructDefinition* owner) {
    for (Candidate& candidate : candidates_)
        if (candidate.name == name && candidate.owner == owner &&
            (owner || candidate.unit == unit_))
            candidate.wanted = true;
}

// The last member of the path; *value is set where that is of struct type.
const Symbol* ObjectExpander::resolve(std::string_view path, const SourceSpan& span,
                                      StructValue* value) {
    std::string_view first = first_name(path);
    const Symbol* symbol = first == "this" ? nullptr : find(first);
    const StructDefinition* structure = symbol ? symbol->structure : nullptr;
    std::string name(placed(path));
    bool array = symbol && symbol->type.is_array();
    if (const Symbol* member = symbol ? nullptr : member_of_object(first)) {
        symbol = member;
        structure = member->structure;
        array = member->type.is_array();
        name = "this->" + name;
    } else if (first == "this" && owner_) {
        structure = owner_;
    }
    if (!structure) {
        if (!symbol)
            report(Code::RSL_UNKNOWN_VARIABLE, span, first);
        else
            report(Code::RSL_NOT_STRUCT, span, first);
        return nullptr;
    }
    std::string_view rest = path.substr(first.size());
    while (!rest.empty()) {
        rest.remove_prefix(kArrow.size());
        std::string_view next = first_name(rest);
        symbol = structure ? find_member(*structure, next) : nullptr;
        if (!symbol && structure) {
            std::vector<std::string_view> names;
            for (const Symbol* member : structure->members) names.push_back(member->name);
            Finding& finding = report(Code::RSL_NO_MEMBER, span, structure->name, next);
            finding.help = meant_help(next, names);
            for (const Function* method : structure->methods)
                if (method->name == next || method->name.starts_with(method_name(*structure, next)))
                    finding.help = fmt::format("it is a method, which is called as '{}()'", path);
            return nullptr;
        }
        if (!symbol) {
            report(Code::RSL_NOT_STRUCT, span, path.substr(0, path.size() - rest.size() - 2));
            return nullptr;
        }
        array = array || symbol->type.is_array();
        structure = symbol->structure;
        rest.remove_prefix(next.size());
    }
    if (structure && value) *value = {structure, name, nullptr, array};
    return symbol;
}

// The members of a value; an error where they are too many.
std::vector<Expr*> ObjectExpander::parts(const StructValue& value, const SourceSpan& span,
                                         Parts how) {
    bool room = copied_ <= kMostCopiedNodes;
    std::vector<Expr*> made = parts_of(ast_, value, span, &copied_, how);
    if (room && copied_ > kMostCopiedNodes)
        report(Code::RSL_TOO_DEEP, span, fmt::format("{} copied members", kMostCopiedNodes));
    made.resize(count_parts(*value.structure, how), TreeBuilder(ast_, span).number(0));
    return made;
}

// Elements that each element of an array of structs holds in the array of this name, as in
// a[i]->list; 0 for all else.
int ObjectExpander::inner_length(const Expr& e) const {
    const auto* element = as_if<IndexExpr>(&e);
    const auto* named = as_if<VariableExpr>(element ? element->array : &e);
    if (!named || !is_member(named->name)) return 0;
    std::string_view path = named->name, first = first_name(path);
    const Symbol* symbol = first == "this" ? nullptr : find(first);
    if (!symbol && first != "this") symbol = member_of_object(first);
    const StructDefinition* structure = symbol ? symbol->structure
                                        : first == "this" ? owner_
                                                          : nullptr;
    bool array = symbol && symbol->type.is_array();
    for (path.remove_prefix(first.size()); !path.empty() && structure;) {
        path.remove_prefix(kArrow.size());
        std::string_view next = first_name(path);
        symbol = find_member(*structure, next);
        if (!symbol) return 0;
        path.remove_prefix(next.size());
        if (path.empty()) return array ? std::max(symbol->type.array_length, 0) : 0;
        array = array || symbol->type.is_array();
        structure = symbol->structure;
    }
    return 0;
}

// What an expression names of struct type; nothing where it is plain.
StructValue ObjectExpander::struct_value(Expr& e) {
    StructValue value;
    auto* element = as_if<IndexExpr>(&e);
    auto* named = as_if<VariableExpr>(element ? element->array : &e);
    if (!named) return value;
    std::string_view first = first_name(named->name);
    const Symbol* symbol = find(first);
    if (!symbol) symbol = member_of_object(first);
    bool object = first == "this" && owner_;
    if (!object && (!symbol || !symbol->structure)) return value;
    if (object && !is_member(named->name)) return {owner_, "this", nullptr, false};
    resolve(named->name, named->span, &value);
    if (element && value.structure) {
        expr(element->index);
        value.index = element->index;
        value.array = false;
    }
    return value;
}

}  // namespace kinora::rsl
