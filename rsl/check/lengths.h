// rsl/check/lengths.h: which resizable arrays have lengths that differ from point to point.
#pragma once

#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Of the arrays that expressions name; what is no variable has one length for all points.
class VaryingLengths {
  public:
    explicit VaryingLengths(size_t symbols) : varies_(symbols) {}

    bool varies(const Symbol& array) const { return varies_[array.id]; }
    bool varies(const Expr* array) const {
        const Symbol* symbol = named(array);
        return symbol && varies(*symbol);
    }
    bool is_fixed(const Expr* array) const {
        const Symbol* symbol = named(array);
        return !symbol || symbol->type.array_length > 0;
    }
    // True if that was not known before.
    bool vary(const Symbol& array) {
        bool before = varies_[array.id];
        varies_[array.id] = true;
        return !before;
    }
    static const Symbol* named(const Expr* array) {
        const auto* variable = as_if<VariableExpr>(array);
        return variable ? variable->symbol : nullptr;
    }

  private:
    std::vector<bool> varies_;  // by Symbol::id
};

}  // namespace kinora::rsl
