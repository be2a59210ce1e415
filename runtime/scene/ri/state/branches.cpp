// runtime/scene/ri/state/branches.cpp: conditional requests. Options and attributes are variables
// of their expressions.
#include "runtime/scene/ri/state/branches.h"

#include "runtime/scene/description/findings.h"

namespace kinora::ri {
namespace {

ConditionValue value_of(const ToldValue& told) {
    if (!told.strings.empty()) return {told.strings[0], 0};
    return {std::nullopt, told.numbers.empty() ? 0 : told.numbers[0]};
}

ConditionValue value_of(const Values& values) {
    if (values.kind() == Values::Kind::Strings) return {std::string(values.string()), 0};
    bool whole = values.kind() == Values::Kind::Integers;
    return {std::nullopt, whole ? values.integer() : double(values.real())};
}

std::optional<ConditionValue> find_told(const std::shared_ptr<const ToldValues>& told,
                                        std::string_view name) {
    if (!told) return std::nullopt;
    auto found = told->find(name);
    if (found == told->end()) return std::nullopt;
    return value_of(found->second);
}

// Takes "Option:" away from "Option:user:pass".
bool take_prefix(std::string_view& name, std::string_view prefix) {
    if (!name.starts_with(prefix)) return false;
    name.remove_prefix(prefix.size());
    return true;
}

}  // namespace

bool Branches::leave_out(const Call& call) {
    if (!skipping_) return false;
    if (call.request == Request::IfBegin) ++inner_;
    if (inner_ > 0) {
        if (call.request == Request::IfEnd) --inner_;
        return true;
    }
    return call.request != Request::ElseIf && call.request != Request::Else &&
           call.request != Request::IfEnd;
}

bool Branches::call(const Call& call) {
    static const Handlers<Branches> kHandlers = {
        {Request::IfBegin, &Branches::begin},
        {Request::ElseIf, &Branches::next},
        {Request::Else, &Branches::next},
        {Request::IfEnd, &Branches::end},
    };
    return kHandlers.call(*this, call);
}

void Branches::begin(const Call& call) {
    open_.push_back({call.where, holds(call)});
    skipping_ = !open_.back().read;
}

void Branches::next(const Call& call) {
    if (open_.empty())
        return report_.add(Code::RI_NESTING, row(call.request).name, "no IfBegin is open");
    bool& read = open_.back().read;
    skipping_ = read || !(call.request == Request::Else || holds(call));
    read = read || !skipping_;
}

void Branches::end(const Call& call) {
    if (open_.empty())
        return report_.add(Code::RI_NESTING, row(call.request).name, "no IfBegin is open");
    open_.pop_back();
    skipping_ = false;
}

void Branches::finish() {
    if (!open_.empty())
        report_.add_at(Code::RI_NESTING, open_.back().where, "IfBegin",
                       "it is not closed at the file's end");
    open_.clear();
    skipping_ = false;
    inner_ = 0;
}

// A name alone is that of a parameter of the request, then of a user's attribute or option.
std::optional<ConditionValue> Branches::look_up(const Call& call, std::string_view name) const {
    if (const Parameter* parameter = call.find(name)) return value_of(parameter->values);
    const bool option = take_prefix(name, "Option:");
    const bool attribute = !option && take_prefix(name, "Attribute:");
    std::optional<ConditionValue> found;
    if (!option && name == "identifier:name" && !state_.attributes.name.empty())
        found = ConditionValue{state_.attributes.name, 0};
    for (const std::string& full : {std::string(name), "user:" + std::string(name)}) {
        if (!option && !found) found = find_told(state_.attributes.told, full);
        if (!attribute && !found) found = find_told(state_.options.told, full);
    }
    if (!found && !attribute && name == "Frame" && state_.frame)
        found = ConditionValue{std::nullopt, double(*state_.frame)};
    return found;
}

bool Branches::holds(const Call& call) {
    Condition made = evaluate_condition(call.arguments[0].string(),
                                        [&](std::string_view name) { return look_up(call, name); });
    std::string_view request = row(call.request).name;
    if (!made.value) report_.add(Code::RI_CONDITION, request, made.why);
    if (!made.unknown.empty() && report_.is_new("condition " + made.unknown))
        report_.add(Code::RI_CONDITION, request,
                    fmt::format("nobody has set '{}', which counts as 0", made.unknown));
    return made.value.value_or(false);
}

}  // namespace kinora::ri
