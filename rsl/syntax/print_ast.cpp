// rsl/syntax/print_ast.cpp: the tree as source text again, in one layout, with only the parentheses
// that the grammar needs.
#include <charconv>

#include "rsl/syntax/ast_visit.h"
#include "rsl/syntax/chain.h"
#include "rsl/syntax/print.h"

namespace kinora::rsl {

int op_level(Op op);

namespace {

constexpr int kLowest = -1, kTernary = 0, kUnary = 9, kPrimary = 10;

}  // namespace

std::string number_text(double value) {
    char buffer[32];
    auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return {buffer, end};
}

std::string quoted(std::string_view text) {
    constexpr std::string_view kSpecial = "\n\t\r\b\f\v", kLetters = "ntrbfv";
    std::string out = "\"";
    for (char c : text) {
        size_t special = kSpecial.find(c);
        if (special != std::string_view::npos)
            (out += '\\') += kLetters[special];
        else if (c == '"' || c == '\\')
            (out += '\\') += c;
        else if (static_cast<unsigned char>(c) < 32)
            out += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
        else
            out += c;
    }
    return out + '"';
}

// ---- expressions --------------------------------------------------------------------------------

namespace {

struct ExprPrinter {
    const ExprNote& note;

    std::string at(const Expr* expr, int lowest) const {
        const auto* hidden = as_if<CastExpr>(expr);
        if (hidden && hidden->implicit && !note) return at(hidden->operand, lowest);
        int level = kPrimary;
        std::string text = visit_expr(*expr, [&](const auto& node) { return print(node, level); });
        return finished(*expr, std::move(text), level, lowest);
    }
    std::string finished(const Expr& expr, std::string text, int level, int lowest) const {
        if (level < lowest) text = "(" + text + ")";
        return note ? note(expr, std::move(text)) : text;
    }
    std::string list(std::span<Expr* const> items) const {
        std::string text;
        for (const Expr* item : items) {
            const auto* points = as_if<ArrayLiteralExpr>(item);  // of "source", written without { }
            text += (text.empty() ? "" : ", ") + (points ? list(points->items) : at(item, kLowest));
        }
        return text;
    }

    std::string print(const NumberExpr& e, int&) const { return number_text(e.value); }
    std::string print(const StringExpr& e, int&) const { return rsl::quoted(e.value); }
    std::string print(const VariableExpr& e, int&) const { return std::string(e.name); }
    std::string print(const IndexExpr& e, int&) const {
        return at(e.array, kPrimary) + "[" + at(e.index, kLowest) + "]";
    }
    std::string print(const ComponentExpr& e, int&) const {
        return at(e.operand, kPrimary) + "[" + at(e.index, kLowest) + "]";
    }
    std::string print(const UnaryExpr& e, int& level) const {
        level = kUnary;
        std::string operand = at(e.operand, kUnary);
        bool doubled = operand[0] == '-';  // "--" is another token
        return op_text(e.op) + (doubled ? "(" + operand + ")" : operand);
    }
    std::string print(const BinaryExpr& e, int& level) const {
        const Chain<const Expr> chain = chain_of<const Expr>(e);
        const Expr* left = chain.first;
        std::string text;
        for (const Expr* link : chain.links) {
            const auto* node = as_if<BinaryExpr>(link);
            if (!node && !note) continue;  // casts of the checker are hidden
            int link_level = node ? op_level(node->op) : kUnary;
            text = left == chain.first ? at(left, link_level)
                                       : finished(*left, std::move(text), level, link_level);
            if (node)
                text.append(" ")
                    .append(op_text(node->op))
                    .append(" ")
                    .append(at(node->right, link_level + 1));
            else
                text = type_name(as<CastExpr>(*link).to) + (" " + text);
            level = link_level;
            left = link;
        }
        return text;
    }
    std::string print(const SelectExpr& e, int& level) const {
        level = kTernary;
        return fmt::format("{} ? {} : {}", at(e.condition, kTernary + 1), at(e.yes, kLowest),
                           at(e.no, kTernary));
    }
    std::string print(const AssignExpr& e, int& level) const {
        level = kLowest;
        return fmt::format("{} {}= {}", at(e.target, kTernary + 1), op_text(e.op),
                           at(e.value, kLowest));
    }
    std::string print(const CallExpr& e, int&) const {
        if (!e.channel) return fmt::format("{}({})", e.name, list(e.args));
        std::string rest = list(e.args.subspan(1));
        return fmt::format("{}({}[{}]{}{})", e.name, at(e.args[0], kPrimary),
                           at(e.channel, kLowest), rest.empty() ? "" : ", ", rest);
    }
    std::string print(const CastExpr& e, int& level) const {
        level = kUnary;
        std::string space = e.space ? at(e.space, kPrimary) + " " : "";
        return fmt::format("{} {}{}", type_name(e.to), space, cast_operand(e));
    }
    // A string right behind the type would be read as its space, a space as part of the string.
    std::string cast_operand(const CastExpr& e) const {
        bool string = e.operand->kind == ExprKind::String;
        std::string text = at(e.operand, kUnary);
        return string && (e.space || e.to != BaseType::String) ? "(" + text + ")" : text;
    }
    std::string print(const TripleExpr& e, int&) const { return "(" + list(e.items) + ")"; }
    std::string print(const SixteenExpr& e, int&) const { return "(" + list(e.items) + ")"; }
    std::string print(const ArrayLiteralExpr& e, int&) const { return "{" + list(e.items) + "}"; }
};

}  // namespace

std::string print_expr(const Expr& expr, const ExprNote& note) {
    return ExprPrinter{note}.at(&expr, kLowest);
}

// ---- definitions and statements -----------------------------------------------------------------

namespace {

class Printer {
  public:
    Printer(const ExprNote& note, const SymbolNote& symbol_note)
        : note_(note), symbol_note_(symbol_note) {}

    void function(const Function& f) {
        line(fmt::format("{} {}({})", type_name(f.result.base), f.name, parameters(f.parameters)));
        statement(*f.body);
    }
    void shader(const ShaderDefinition& s) {
        line(fmt::format("{} {}({})", shader_kind_name(s.kind), s.name, parameters(s.parameters)));
        statement(*s.body);
    }
    std::string take() { return std::move(out_); }

  private:
    std::string expr(const Expr* e) const { return print_expr(*e, note_); }
    std::string list(std::span<Expr* const> items) const {
        std::string text;
        for (const Expr* item : items) text += (text.empty() ? "" : ", ") + expr(item);
        return text;
    }
    void line(const std::string& text) {
        out_.append(size_t(indent_) * 4, ' ');
        out_ += text;
        out_ += '\n';
    }
    std::string head(const Symbol& s) const {
        std::string text = s.output ? "output " : "";
        if (s.detail != Detail::Unspecified) text += std::string(detail_name(s.detail)) + " ";
        return text + type_name(s.type.base) + " ";
    }
    std::string declarator(const Symbol& s) const {
        std::string text(s.name);
        if (s.type.array_length > 0) text += fmt::format("[{}]", s.type.array_length);
        if (s.type.array_length == 0) text += "[]";
        if (s.initial) text += " = " + expr(s.initial);
        return symbol_note_ ? text + symbol_note_(s) : text;
    }
    std::string parameters(std::span<Symbol* const> symbols) const {
        std::string text;
        for (const Symbol* s : symbols) {
            if (!text.empty()) text += "; ";
            text += head(*s) + declarator(*s);
        }
        return text;
    }
    void declare(const char* prefix, std::span<Symbol* const> symbols) {
        if (symbols.empty()) return;
        std::string text = prefix + head(*symbols[0]);
        for (const Symbol* s : symbols) text += (s == symbols[0] ? "" : ", ") + declarator(*s);
        line(text + ";");
    }
    // A body: blocks at the same indent, anything else one deeper.
    void body(const Stmt& s) {
        bool deeper = s.kind != StmtKind::Block;
        indent_ += deeper;
        statement(s);
        indent_ -= deeper;
    }
    void statement(const Stmt& s) {
        visit_stmt(s, [&](const auto& node) { print(node); });
    }

    void print(const BlockStmt& s) {
        line("{");
        ++indent_;
        for (const Stmt* item : s.body) statement(*item);
        --indent_;
        line("}");
    }
    void print(const DeclareStmt& s) { declare("", s.symbols); }
    void print(const ExternStmt& s) { declare("extern ", s.symbols); }
    void print(const FunctionStmt& s) { function(*s.function); }
    void print(const ExpressionStmt& s) { line(expr(s.expression) + ";"); }
    void print(const IfStmt& s) {
        line(fmt::format("if ({})", condition(s.condition)));
        // An if without else as the yes-branch of one with else needs a block of its own.
        bool dangling = s.no && s.yes->kind != StmtKind::Block;
        if (dangling) line("{");
        body(*s.yes);
        if (dangling) line("}");
        if (!s.no) return;
        line("else");
        body(*s.no);
    }
    void print(const WhileStmt& s) {
        line(fmt::format("while ({})", condition(s.condition)));
        body(*s.body);
    }
    // An assignment as a condition keeps the parentheses that show it is meant.
    std::string condition(const Expr* e) const {
        return e->kind == ExprKind::Assign ? "(" + expr(e) + ")" : expr(e);
    }
    void print(const ForStmt& s) {
        std::string init;
        for (const Stmt* item : s.init) {
            if (const auto* e = as_if<ExpressionStmt>(item))
                init += (init.empty() ? "" : ", ") + expr(e->expression);
            else if (const auto* d = as_if<DeclareStmt>(item))
                for (const Symbol* symbol : d->symbols)
                    init += (init.empty() ? head(*symbol) : ", ") + declarator(*symbol);
        }
        line(fmt::format("for ({}; {}; {})", init, s.condition ? expr(s.condition) : "",
                         list(s.step)));
        body(*s.body);
    }
    void print(const BreakStmt& s) { line(jump("break", s.levels)); }
    void print(const ContinueStmt& s) { line(jump("continue", s.levels)); }
    static std::string jump(const char* word, int levels) {
        return levels == 1 ? fmt::format("{};", word) : fmt::format("{} {};", word, levels);
    }
    void print(const ReturnStmt& s) {
        line(s.value ? "return " + expr(s.value) + ";" : std::string("return;"));
    }
    void print(const IlluminanceStmt& s) {
        line(fmt::format("illuminance({})", list(s.args)));
        body(*s.body);
    }
    void print(const IlluminateStmt& s) {
        std::string cone = s.axis ? ", " + expr(s.axis) + ", " + expr(s.angle) : "";
        line(fmt::format("illuminate({}{})", expr(s.position), cone));
        body(*s.body);
    }
    void print(const SolarStmt& s) {
        line(fmt::format("solar({})", s.axis ? expr(s.axis) + ", " + expr(s.angle) : ""));
        body(*s.body);
    }
    void print(const GatherStmt& s) {
        line(fmt::format("gather({})", list(s.args)));
        body(*s.body);
        if (!s.missed) return;
        line("else");
        body(*s.missed);
    }

    const ExprNote& note_;
    const SymbolNote& symbol_note_;
    std::string out_;
    int indent_ = 0;
};

}  // namespace

std::string print_tree(const Ast& ast, const ExprNote& note, const SymbolNote& symbol_note) {
    Printer printer(note, symbol_note);
    for (const Function* f : ast.functions) printer.function(*f);
    for (const ShaderDefinition* s : ast.shaders) printer.shader(*s);
    return printer.take();
}

}  // namespace kinora::rsl
