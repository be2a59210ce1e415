// rsl/syntax/open_definition.h: the shader or function that is being parsed, and what it declares.
#pragma once

#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

class OpenDefinition {
  public:
    void begin_shader();
    // Functions nest: one begins inside the one that is open, which is open again at its end.
    void begin_function(Function& f);
    void end_function(const Function& f) { function_ = f.parent; }

    void declare(Symbol& symbol);
    void add_return(ReturnStmt& node);

    // The first "return;" of the shader itself; null if it has none.
    const ReturnStmt* shader_return() const { return shader_return_; }
    // Makes what the shader's body declares belong to a function.
    void move_body_into(Function& f);

  private:
    Function* function_ = nullptr;  // null in a shader's body
    ReturnStmt* shader_return_ = nullptr;
    std::vector<Symbol*> shader_locals_;       // what the shader's body declares
    std::vector<Function*> shader_functions_;  // and the functions it defines
};

}  // namespace kinora::rsl
