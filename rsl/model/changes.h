// rsl/model/changes.h: what lowering must know of a piece of source before it writes code for it.
#pragma once

#include <vector>

#include "rsl/syntax/ast_parts.h"

namespace kinora::rsl {

// What a statement or expression may change or do, functions it calls included. A loop carries just
// these.
struct Changes {
    std::vector<const Symbol*> symbols;      // written, each once
    std::vector<const Stmt*> breaks;         // loops that a break leaves
    std::vector<const Stmt*> continues;      // loops that a continue goes on with
    std::vector<const Stmt*> light_sources;  // illuminate and solar statements
    bool returns = false;                    // from the function it stands in
    bool random = false;                     // calls random()
    bool calls = false;                      // calls functions of the source
    uint32_t effects = 0;                    // Effects of all built-ins called, joined
};

// Collects the changes of any number of nodes.
class ChangeFinder {
  public:
    explicit ChangeFinder(const Ast& ast)
        : seen_symbols_(ast.symbol_count), seen_functions_(ast.function_count) {}
    void add(const Stmt* stmt);  // null is allowed
    void add(const Expr* expr);
    void add(const Function& body);

    Changes changes;
    std::vector<const Symbol*> used;  // every variable named, each once

  private:
    void written(const Expr* target);
    void note_use(const Symbol* symbol);
    std::vector<uint8_t> seen_symbols_;  // bit 0 used, bit 1 written
    std::vector<uint8_t> seen_functions_;
};

// Arrays that must lie in memory, by Symbol::id: indexed by something not constant, or long.
// Functions pass arrays by reference, so what one indexes marks what its callers hand it.
std::vector<uint8_t> memory_arrays(const Ast& ast);

// How many elements resizable arrays have room for, by Symbol::id: what resize() and reserve() ask
// for by numbers, or a customary count.
std::vector<int> array_capacities(const Ast& ast);

}  // namespace kinora::rsl
