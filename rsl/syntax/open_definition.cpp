// rsl/syntax/open_definition.cpp: who owns what is declared.
#include "rsl/syntax/open_definition.h"

namespace kinora::rsl {

void OpenDefinition::begin_shader() {
    shader_return_ = nullptr;
    shader_locals_.clear();
    shader_functions_.clear();
}

void OpenDefinition::begin_function(Function& f) {
    f.parent = function_;
    if (!function_) shader_functions_.push_back(&f);
    function_ = &f;
}

void OpenDefinition::declare(Symbol& symbol) {
    symbol.function = function_;
    if (!function_ && symbol.kind == SymbolKind::Local) shader_locals_.push_back(&symbol);
}

void OpenDefinition::add_return(ReturnStmt& node) {
    if (function_ && node.value) function_->returns = true;
    if (!function_ && !node.value && !shader_return_) shader_return_ = &node;
}

void OpenDefinition::move_body_into(Function& f) {
    for (Symbol* local : shader_locals_) local->function = &f;
    for (Function* nested : shader_functions_) nested->parent = &f;
}

}  // namespace kinora::rsl
