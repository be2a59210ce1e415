// rsl/reference/observe.cpp: what an observer is told of a run.
#include <algorithm>
#include <cmath>

#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace {

template <class Real>
bool has_nan(const RefValue<Real>& x) {
    if (!is_numeric(x.type)) return false;
    return std::any_of(x.c.begin(), x.c.begin() + std::ptrdiff_t(x.size()),
                       [](const Dual<Real>& c) { return std::isnan(c.x); });
}

template <class Real>
void append(const RefValue<Real>& value, std::vector<double>& numbers) {
    for (size_t k = 0; k < value.size(); ++k) numbers.push_back(double(value.c[k].x));
}

}  // namespace

// Operands are evaluated before: the first to give a NaN did not get one, unless the inputs had it.
template <class Real>
auto Reference<Real>::observed(const Expr& e) -> Item {
    Item value = evaluate(e);
    bool computes = e.kind == ExprKind::Binary || e.kind == ExprKind::Call ||
                    e.kind == ExprKind::Assign || e.kind == ExprKind::Cast;
    if (computes && result.nan.file == kNoFile && has_nan(value)) result.nan = e.span.where;
    return value;
}

template <class Real>
void Reference<Real>::note_change(const Symbol& symbol) {
    if (std::find(changed_.begin(), changed_.end(), &symbol) == changed_.end())
        changed_.push_back(&symbol);
}

template <class Real>
ReferenceVariable Reference<Real>::variable(Global id, const Item& value) const {
    const GlobalInfo& info = global_info(id);
    ReferenceVariable told{info.name, info.type, true, {}};
    append(value, told.values);
    return told;
}

template <class Real>
ReferenceVariable Reference<Real>::variable(const Symbol& symbol) {
    if (symbol.global) return variable(symbol.global->id, global(symbol.global->id));
    ReferenceVariable told{symbol.name, symbol.type, symbol.varying, {}};
    const Storage& items = storage(symbol);
    for (const Item& item : items) append(item, told.values);
    if (symbol.type.is_array()) told.type.array_length = int(items.size());
    return told;
}

template <class Real>
ReferenceStep Reference<Real>::step_at(const Location& where) const {
    return {layer->shader, function_, where, loop_counters, light, {}};
}

template <class Real>
void Reference<Real>::tell_changes(const Location& where) {
    ReferenceStep step = step_at(where);
    for (const Symbol* symbol : changed_) step.changes.push_back(variable(*symbol));
    changed_.clear();
    in.observer(step);
}

template <class Real>
void Reference<Real>::tell_inputs() {
    changed_.clear();
    const Shader& shader = *layer->shader;
    ReferenceStep step = step_at(shader.definition->span.where);
    for (const ShaderParameter& p : shader.parameters) step.changes.push_back(variable(*p.symbol));
    for (const GlobalInfo* info : shader.globals_read) {
        Global id = info->id;
        bool of_light = id == Global::L || id == Global::Cl || id == Global::Ol;
        if (of_light || id == Global::PI) continue;
        auto set = globals_.find(id);
        step.changes.push_back(variable(id, set == globals_.end() ? first_value(id) : set->second));
    }
    in.observer(step);
}

template <class Real>
void Reference<Real>::tell_light(const Location& where) {
    ReferenceStep step = step_at(where);
    for (Global id : {Global::L, Global::Cl, Global::Ol})
        step.changes.push_back(variable(id, global(id)));
    for (const Symbol* symbol : changed_) step.changes.push_back(variable(*symbol));
    changed_.clear();
    in.observer(step);
}

#define KINORA_OBSERVE_METHODS(Real)                              \
    template auto Reference<Real>::observed(const Expr&)->Item;   \
    template void Reference<Real>::note_change(const Symbol&);    \
    template void Reference<Real>::tell_changes(const Location&); \
    template void Reference<Real>::tell_inputs();                 \
    template void Reference<Real>::tell_light(const Location&);
KINORA_OBSERVE_METHODS(float)
KINORA_OBSERVE_METHODS(double)

}  // namespace kinora::rsl
