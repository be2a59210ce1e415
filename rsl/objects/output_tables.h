// rsl/objects/output_tables.h: writeaov() and readaov() of names that are known at run time alone.
#pragma once

#include <string>
#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// A shader with such a call keeps what it writes in tables, one for floats and one for triples:
// names beside values. Its calls of literal names that it does not declare use them too.
class OutputTables {
  public:
    explicit OutputTables(Ast& ast) : ast_(ast) {}

    // Whether a source has such calls.
    static bool are_in(const Ast& ast);
    // Calls of the shader's are meant; null: the source has several.
    void begin(const ShaderDefinition* shader);
    // True if the call now is one of the tables' functions.
    bool rewrite(CallExpr& e);
    // Gives the shader its tables and functions.
    void end(ShaderDefinition& shader);

  private:
    bool declares(std::string_view name) const;
    NamedTable add_table(BaseType type, SourceSpan span, std::vector<Stmt*>& front);
    Function* function(std::string_view name, const NamedTable& table, bool writes);
    std::vector<Stmt*> declared_outputs(const NamedTable& table, bool writes);
    Stmt* search(const NamedTable& table, bool writes);

    Ast& ast_;
    const ShaderDefinition* shader_ = nullptr;
    std::vector<NamedWrite> writes_;
    bool used_ = false;
    SourceSpan span_;
};

}  // namespace kinora::rsl
