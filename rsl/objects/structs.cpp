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

}  // namespace

bool has_open_arrays(const StructDefinition& structure) {
    return std::any_of(structure.members.begin(), structure.members.end(), [](const Symbol* m) {
        return m->type.array_length == 0 || m->resizable ||
               (m->structure && (has_open_arrays(*m->structure) ||
                                 (m->type.is_array() && has_arrays(*m->structure))));
    });
}

bool has_arrays(const StructDefinition& structure) {
    return std::any_of(structure.members.begin(), structure.members.end(), [](const Symbol* m) {
        return m->type.is_array() || (m->structure && has_arrays(*m->structure));
    });
}

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

Expr* flat_index(Ast& ast, const SourceSpan& span, Expr* i, int length, Expr* j) {
    TreeBuilder make(ast, span);
    return make.call("elementof", {i, make.number(length), j});
}

std::vector<Expr*> parts_of(Ast& ast, const StructValue& value, const SourceSpan& span,
                            size_t* nodes, Parts how) {
    TreeBuilder make(ast, span);
    std::vector<Expr*> parts;
    for (const Leaf& leaf : leaves_of(*value.structure)) {
        std::string name = value.name + leaf.path;
        int length = how == Parts::Elements ? std::max(leaf.member->type.array_length, -1) : -1;
        for (int k = 0; k < std::max(length, 1); ++k) {
            if (*nodes > kMostCopiedNodes) return parts;
            ++*nodes;
            if (!value.index && length < 0)
                parts.push_back(make.variable(name));
            else if (!value.index)
                parts.push_back(make.element(name, *make.number(k), nodes));
            else if (length < 0)
                parts.push_back(make.element(name, *value.index, nodes));
            else
                parts.push_back(make.element(
                    name, *flat_index(ast, span, copy_tree(ast, *value.index, nodes), length,
                                      make.number(k)),
                    nodes));
        }
    }
    return parts;
}

size_t count_parts(const StructDefinition& structure, Parts parts) {
    size_t count = 0;
    for (const Leaf& leaf : leaves_of(structure))
        count += size_t(parts == Parts::Elements ? std::max(leaf.member->type.array_length, 1) : 1);
    return count;
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
        int inner = leaf.member->type.array_length, each = std::max(inner, 1);
        part->type = {leaf.member->type.base,
                      of_array ? symbol.type.array_length * each : inner};
        part->resizable = of_array ? symbol.resizable : !formal && leaf.member->resizable;
        if (of_array && symbol.length) {
            TreeBuilder make(ast, symbol.span);
            part->length = copy_tree(ast, *symbol.length);
            if (each > 1)
                part->length = make.binary(Op::Multiply, part->length, make.number(each));
        }
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
            const auto* list = as_if<ArrayLiteralExpr>(first);
            for (int k = 0; k < symbol.type.array_length; ++k) {
                if (!list) items.push_back(copy_tree(ast, *first));
                for (const Expr* item : list ? list->items : std::span<Expr*>())
                    items.push_back(copy_tree(ast, *item));
            }
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
            bool nested = known && member->type.is_array() && has_open_arrays(*member->structure);
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
