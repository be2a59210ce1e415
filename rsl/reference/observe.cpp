// rsl/reference/observe.cpp: what an observer is told of a run.
#include <cmath>

#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace {

template <class Real>
bool has_nan(const RefValue<Real>& x) {
    bool nan = false;
    for (size_t k = 0; k < x.size(); ++k) nan = nan || std::isnan(x.c[k].x);
    return nan;
}

template <class Real>
void append(const RefValue<Real>& value, std::vector<double>& numbers) {
    size_t first = numbers.size();
    numbers.resize(first + value.size());
    for (size_t k = 0; k < value.size(); ++k) numbers[first + k] = double(value.c[k].x);
}

}  // namespace

// Operands are evaluated before: the first to give a NaN did not get one, unless the inputs had it.
template <class Real>
auto Reference<Real>::observed(const Expr& e) -> Item {
    Item value = evaluate(e);
    note_first_nan(e, value);
    return value;
}

template <class Real>
void Reference<Real>::note_first_nan(const Expr& e, const Item& value) {
    if (!in.observer) [[likely]]
        return;
    bool computes = e.kind == ExprKind::Binary || e.kind == ExprKind::Call;
    if (computes && result.nan.file == kNoFile && has_nan(value)) result.nan = e.span.where;
}

template <class Real>
void Reference<Real>::note_change(const Symbol& symbol) {
    if (!in.observer) return;
    for (const Symbol* known : changed_)
        if (known == &symbol) return;
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

// `changes` come before those of variables.
template <class Real>
void Reference<Real>::tell_step(const Location& where, std::vector<ReferenceVariable> changes) {
    for (const Symbol* symbol : changed_) changes.push_back(variable(*symbol));
    changed_.clear();
    (*in.observer)({layer->shader, function_, where, loop_counters, light, std::move(changes)});
}

template <class Real>
void Reference<Real>::tell_changes(const Location& where) {
    if (!changed_.empty()) tell_step(where, {});
}

template <class Real>
void Reference<Real>::tell_inputs() {
    changed_.clear();
    const Shader& shader = *layer->shader;
    for (const ShaderParameter& p : shader.parameters) note_change(*p.symbol);
    std::vector<ReferenceVariable> changes;
    for (const GlobalInfo* info : shader.globals_read) {
        Global id = info->id;
        bool of_light = id == Global::L || id == Global::Cl || id == Global::Ol;
        if (of_light || id == Global::PI) continue;
        auto set = globals_.find(id);
        changes.push_back(variable(id, set == globals_.end() ? first_value(id) : set->second));
    }
    tell_step(shader.definition->span.where, std::move(changes));
}

template <class Real>
void Reference<Real>::tell_light(const Location& where) {
    std::vector<ReferenceVariable> changes;
    for (Global id : {Global::L, Global::Cl, Global::Ol})
        changes.push_back(variable(id, global(id)));
    tell_step(where, std::move(changes));
}

template auto Reference<float>::observed(const Expr&) -> Item;
template void Reference<float>::note_first_nan(const Expr&, const Item&);
template void Reference<float>::note_change(const Symbol&);
template void Reference<float>::tell_changes(const Location&);
template void Reference<float>::tell_inputs();
template void Reference<float>::tell_light(const Location&);

}  // namespace kinora::rsl
