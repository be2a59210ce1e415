// rsl/objects/handle_sets.h: which shaders a variable of type shader can mean, and so who calls
// whom. It is known before any type is: variables of one unit that have the same name are one, as
// are the members of structs, which only makes sets larger than they need be.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Bit 0 is null, bit k + 1 unit k; a handle's number is that of its bit. The last bit is all lights
// of the scene, whose numbers are below 0.
using HandleSet = uint64_t;
constexpr HandleSet kNullHandle = 1;
constexpr HandleSet handle_of(size_t unit) {
    return HandleSet(2) << unit;
}
constexpr size_t kMostUnits = 62;
constexpr HandleSet kLightHandles = HandleSet(1) << 63;
// The units of a set, in order.
std::vector<size_t> units_of(HandleSet set);

// A call of a method of another unit, or of a function of its own.
struct UnitCall {
    size_t unit, callee_unit;
    const Function* caller;  // null: a value of a member
    const Function* callee;
    SourceSpan span;
};

class HandleSets {
  public:
    HandleSets(const Ast& ast, const std::vector<Unit>& units);

    HandleSet of(size_t unit, const Expr& e) const;
    // A function of that name gives a handle.
    bool gives_handle(size_t unit, std::string_view name) const {
        return giving_.contains({int(unit), std::string(name)});
    }
    // Which the shader itself can come to, with those that these can.
    HandleSet used() const;
    // Those of the set, each behind those whose methods its construct() and begin() call.
    std::vector<size_t> in_order(HandleSet used) const;
    // Calls that lead through several units and back; empty if there are none.
    std::vector<UnitCall> cycle() const;

  private:
    using Key = std::pair<int, std::string>;  // -1: member of a struct

    std::vector<Key> keys_of(size_t unit, const Expr& target) const;
    HandleSet of_path(size_t unit, std::string_view path) const;
    HandleSet of_call(size_t unit, const CallExpr& e) const;
    HandleSet of_text(size_t unit, const Expr& e) const;
    HandleSet at(const Key& key) const;
    void add(const Key& key, HandleSet set);

    void list(size_t unit, const Function& f);
    void list_nested(size_t unit, const Stmt& stmt);
    void unit_definitions(size_t unit);
    void parameters(size_t unit);
    void declared(size_t unit, const Symbol& symbol);
    void function(size_t unit, const Function& f);
    void statement(size_t unit, const Function* f, const Stmt& stmt);
    void expression(size_t unit, const Function* f, const Expr& e);
    void call(size_t unit, const Function* f, const CallExpr& e);
    void pass(size_t unit, const Function* f, const CallExpr& e, size_t callee_unit,
              const Function& callee);
    bool search(const UnitCall& from, std::vector<UnitCall>& path,
                std::set<const Function*>& done) const;

    const Ast& ast_;
    const std::vector<Unit>& units_;
    std::map<Key, HandleSet> sets_;
    std::set<Key> giving_;
    std::map<Key, std::vector<std::pair<size_t, const Function*>>> functions_;
    std::vector<HandleSet> mentioned_;  // by unit
    std::vector<UnitCall> calls_;
    std::set<const Function*> walked_;
    bool changed_ = false;
};

}  // namespace kinora::rsl
