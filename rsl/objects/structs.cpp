// rsl/objects/structs.cpp: variables of struct types: their members as variables.
#include "rsl/objects/structs.h"

#include <algorithm>
#include <map>

#include "rsl/syntax/copy_tree.h"

namespace kinora::rsl {

namespace {

void add_leaves(const StructDefinition& structure, const std::string& path,
                std::vector<Leaf>& leaves) {
    for (const Symbol* member : structure.members) {
        std::string inner = path + "->" + std::string(member->name);
        if (member->structure)
            add_leaves(*member->structure, inner, leaves);
        else
            leaves.push_back({std::move(inner), member});
    }
}

bool has_arrays(const StructDefinition& structure) {
    return std::any_of(structure.members.begin(), structure.members.end(), [](const Symbol* m) {
        return m->type.is_array() || (m->structure && has_arrays(*m->structure));
    });
}

}  // namespace

std::vector<Leaf> leaves_of(const StructDefinition& structure) {
    std::vector<Leaf> leaves;
    add_leaves(structure, "", leaves);
    return leaves;
}

const Symbol* find_member(const StructDefinition& structure, std::string_view name) {
    for (const Symbol* member : structure.members)
        if (member->name == name) return member;
    return nullptr;
}

std::vector<Expr*> parts_of(Ast& ast, const StructValue& value, const SourceSpan& span,
                            size_t* nodes) {
    TreeBuilder make(ast, span);
    std::vector<Expr*> parts;
    for (const Leaf& leaf : leaves_of(*value.structure)) {
        if (*nodes > kMostCopiedNodes) break;
        ++*nodes;
        std::string name = value.name + leaf.path;
        parts.push_back(value.index ? make.element(name, *value.index, nodes)
                                    : make.variable(name));
    }
    return parts;
}

std::vector<Symbol*> expanded(Ast& ast, const Symbol& symbol) {
    constexpr int kMostDefaults = 256;
    std::vector<Symbol*> symbols;
    bool formal = symbol.kind == SymbolKind::FunctionParameter;
    for (const Leaf& leaf : leaves_of(*symbol.structure)) {
        auto* part = ast.arena.make<Symbol>();
        *part = symbol;
        part->id = ast.symbol_count++;
        part->name = ast.arena.copy(std::string(symbol.name) + leaf.path);
        part->structure = nullptr;
        part->initial = part->length = nullptr;
        bool of_array = symbol.type.is_array();
        part->type = {leaf.member->type.base,
                      of_array ? symbol.type.array_length : leaf.member->type.array_length};
        part->resizable = of_array ? symbol.resizable : !formal && leaf.member->resizable;
        if (of_array && symbol.length) part->length = copy_tree(ast, *symbol.length);
        if (!of_array && leaf.member->length && !formal)
            part->length = copy_tree(ast, *leaf.member->length);
        if (formal) {
            part->output = true;  // structs are passed by reference
            bool uniform = leaf.member->detail == Detail::Uniform;
            part->detail = uniform ? Detail::Uniform : Detail::Unspecified;
        } else if (leaf.member->detail != Detail::Unspecified) {
            part->detail = leaf.member->detail;
        }
        const Expr* first = formal || symbol.initial ? nullptr : leaf.member->initial;
        if (first && !of_array) {
            part->initial = copy_tree(ast, *first);
        } else if (first && symbol.type.array_length > 0 &&
                   symbol.type.array_length <= kMostDefaults) {
            auto* literal = ast.make<ArrayLiteralExpr>(symbol.span);
            std::vector<Expr*> items;
            for (int k = 0; k < symbol.type.array_length; ++k)
                items.push_back(copy_tree(ast, *first));
            literal->items = ast.arena.copy(items);
            part->initial = literal;
        }
        symbols.push_back(part);
    }
    return symbols;
}

bool check_structs(const Ast& ast, Reporter& reporter) {
    constexpr size_t kMostLeaves = 4096;
    bool good = true;
    std::map<const StructDefinition*, size_t> sizes;
    for (size_t i = 0; i < ast.structs.size(); ++i) {
        for (const Symbol* member : ast.structs[i]->members) {
            if (!member->structure) continue;
            const Token& at = ast.tokens.tokens[member->span.token];
            auto earlier = ast.structs.begin() + long(i);
            bool known = std::find(ast.structs.begin(), earlier, member->structure) != earlier;
            if (!known)
                reporter.report(Code::RSL_STRUCT_IN_ITSELF, at, member->name, ast.structs[i]->name);
            bool nested = known && member->type.is_array() && has_arrays(*member->structure);
            if (nested) reporter.report(Code::RSL_STRUCT_ARRAYS, at, member->structure->name);
            good = good && known && !nested;
        }
        size_t size = 0;
        for (const Symbol* member : ast.structs[i]->members)
            size += member->structure ? sizes[member->structure] : 1;
        sizes[ast.structs[i]] = std::min(size, 2 * kMostLeaves);
        if (size <= kMostLeaves) continue;
        const Token& at = ast.tokens.tokens[ast.structs[i]->span.token];
        reporter.report(Code::RSL_TOO_DEEP, at, fmt::format("{} members", kMostLeaves));
        return false;
    }
    return good;
}

}  // namespace kinora::rsl
