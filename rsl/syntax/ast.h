// rsl/syntax/ast.h: the syntax tree of shader source. The parser makes it; the checker completes
// the same nodes (types, symbols, callees, casts), after which no name needs looking up: lowering
// and the reference evaluator are plain walks. Nodes live in the Ast's arena and are trivially
// destructible.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "rsl/syntax/types.h"
#include "rsl/text/token.h"
#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

struct Expr;
struct Stmt;
struct Function;
struct StructDefinition;
struct GlobalInfo;  // rsl/model/globals.h
struct Builtin;     // rsl/model/builtin.h
struct Signature;

// Where a node stands. `where` is in bytes of the user's file (for a token out of a macro:
// where it is used); `token` leads to the macros it came through (Ast::tokens).
struct SourceSpan {
    Location where;
    uint32_t token = 0;
};

// ---- symbols ------------------------------------------------------------------------------------

enum class SymbolKind : uint8_t { Global, Parameter, Local, FunctionParameter };

struct Symbol {
    SymbolKind kind = SymbolKind::Local;
    std::string_view name;
    Type type;
    Detail detail = Detail::Unspecified;  // as declared
    bool output = false;                  // declared `output`
    bool constant = false;                // declared `constant`: set at first or in construct()
    bool assigned = false;                // written anywhere (checker)
    bool varying = false;                 // inferred: point rate (checker)
    uint32_t id = 0;  // dense in the Ast, 0 .. symbol_count-1: index of side tables
    SourceSpan span;
    bool resizable = false;   // an array whose length changes: RSL 2.0's "float a[];"
    bool handle = false;      // of type shader: a float that names a linked shader, 0 for null
    bool accessible = false;  // a class's member: declared public
    bool kept = false;        // a variable of the shader's body that is read behind its end
    bool open = false;        // a shader's parameter "T a[]": as long as what it is bound to
    Expr* initial = nullptr;  // initialiser, or a parameter's default; may be null
    Expr* length = nullptr;   // of a resizable array, at first; null: 0, or that of `initial`
    // The struct that it is of, whose members stand in its place after expand_objects().
    const StructDefinition* structure = nullptr;
    const GlobalInfo* global = nullptr;  // kind Global: its row of globals.def
    Function* function = nullptr;        // the function it belongs to; null in the shader's body
};

// ---- expressions --------------------------------------------------------------------------------

enum class ExprKind : uint8_t {
    Number,
    String,
    Variable,
    Index,
    Component,
    Unary,
    Binary,
    Select,
    Assign,
    Call,
    Cast,
    Triple,
    Sixteen,
    ArrayLiteral,
};

// Arithmetic works componentwise on triples (a float operand is cast to the triple first); Multiply
// and Divide of matrices are matrix products (a / b = a * inverse(b)). Dot and Cross take triples
// that are no colors. Comparisons of triples: == all components equal, != any differs.
enum class Op : uint8_t {
    None,
    Add,
    Subtract,
    Multiply,
    Divide,
    Dot,
    Cross,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Not,
    Negate,
};
const char* op_text(Op op);  // "+", "<=", "." ...

struct Expr {
    ExprKind kind;
    Rate rate = Rate::Varying;         // checker
    bool rated = false;                // checker: a shader that uses it set its rate
    Type type{BaseType::Invalid, -1};  // checker
    SourceSpan span;
};

// 0.5: type Float.
struct NumberExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Number;
    double value = 0;
};
// "world": escapes are already decoded; neighbouring literals are joined.
struct StringExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::String;
    std::string_view value;
};
// A variable as a value or as the target of an assignment; arrays as whole arguments too. A member
// of a struct is the variable "a->b"; one of an element of an array is an element of "a->b".
struct VariableExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Variable;
    std::string_view name;
    Symbol* symbol = nullptr;  // checker
};
// array[index]: `array` is a VariableExpr of array type; the index is a Float, truncated, clamped.
// Elements of a resizable array are those below its length of the moment.
struct IndexExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Index;
    Expr* array = nullptr;
    Expr* index = nullptr;
};
// Ci[0]: one component of a triple. The parser makes IndexExpr; the checker replaces it when the
// operand is a triple (an l-value if the operand is one).
struct ComponentExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Component;
    Expr* operand = nullptr;
    Expr* index = nullptr;  // Float, truncated, clamped to 0..2
};
// -a (Negate; triples, matrices too), !a (Not; Bool).
struct UnaryExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Unary;
    Op op = Op::None;
    Expr* operand = nullptr;
};
// a op b. After check both sides have the same type, except the sides of And/Or (both Bool).
// The right side of And and Or runs only where the left one does not tell (RSL leaves it open; it
// shows where the right side assigns, calls or indexes).
struct BinaryExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Binary;
    Op op = Op::None;
    Expr* left = nullptr;
    Expr* right = nullptr;
};
// condition ? yes : no; the condition is Bool, both sides have the node's type.
struct SelectExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Select;
    Expr* condition = nullptr;
    Expr* yes = nullptr;
    Expr* no = nullptr;
};
// target op= value; op None is plain `=`. The target is a Variable, Index or Component node; value
// has its type (whole arrays too, of equal length). The node's value is the target's new value.
struct AssignExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Assign;
    Op op = Op::None;  // None, Add, Subtract, Multiply, Divide
    Expr* target = nullptr;
    Expr* value = nullptr;
};
// name(args) or texture(name[channel], args). After check exactly one of `function` and `builtin`
// is set; every argument has the parameter's type, output arguments are l-values of that type
// (triples: any triple type) and, for built-ins, args[pairs..] are the "name", value pairs.
struct CallExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Call;
    std::string_view name;
    bool method = false;  // object->name(args): args[0] is the object; gone after expand_objects()
    std::span<Expr*> args;
    Expr* channel = nullptr;               // texture-like calls: the [n] after the first argument
    Function* function = nullptr;          // user function
    const Builtin* builtin = nullptr;      // row
    const Signature* signature = nullptr;  // the overload; signature->overload is its index
    uint32_t pairs = 0;                    // index of the first pair; args.size() if there is none
    uint32_t site = 0;                     // dense number of the call in the Ast (random streams)
};
// A conversion: written (`color x`, `vector "world" x`, `(float) x`, `float noise(P)`) or, with
// `implicit`, put in by the checker. to == from is a no-op. Float -> triple spreads, Float ->
// Matrix is the diagonal, triple -> triple keeps the components, Bool -> Float gives 0/1, Float ->
// Bool is
// != 0. With `space`: components are in that space (point, vector, normal, matrix: transform to
// current as that type; color: to rgb), whatever the operand's type was.
struct CastExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Cast;
    BaseType to = BaseType::Invalid;
    bool implicit = false;
    Expr* space = nullptr;  // a string expression, or null
    Expr* operand = nullptr;
};
// (x, y, z): three Floats. The type is what is wanted of it, Point when nothing is.
struct TripleExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Triple;
    Expr* items[3] = {};
};
// (m00, m01, ... m33): sixteen Floats, row-major with row vectors, as RSL has it (translation in
// the last four). Type Matrix.
struct SixteenExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::Sixteen;
    std::span<Expr*> items;
};
// { a, b, c }: only as an initialiser of an array; each item has the element type. When shorter
// than the array the rest is 0 (or "").
struct ArrayLiteralExpr : Expr {
    static constexpr ExprKind kKind = ExprKind::ArrayLiteral;
    std::span<Expr*> items;
};

// ---- statements ---------------------------------------------------------------------------------

enum class StmtKind : uint8_t {
    Block,
    Declare,
    Extern,
    DefineFunction,
    Expression,
    If,
    While,
    For,
    Break,
    Continue,
    Return,
    Illuminance,
    Illuminate,
    Solar,
    Gather,
};

struct Stmt {
    StmtKind kind;
    SourceSpan span;
};

// { ... } with a scope of its own.
struct BlockStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Block;
    std::span<Stmt*> body;
};
// float a = 1, b; each symbol's `initial` is assigned here, in order; without one it becomes 0 or
// "".
struct DeclareStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Declare;
    std::span<Symbol*> symbols;
};
// extern float x; names a variable of the enclosing function or shader; does nothing after check.
struct ExternStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Extern;
    std::span<Symbol*> symbols;
};
// A nested function; does nothing when reached.
struct FunctionStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::DefineFunction;
    Function* function = nullptr;
};
struct ExpressionStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Expression;
    Expr* expression = nullptr;
};
struct IfStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::If;
    Expr* condition = nullptr;  // Bool
    Stmt* yes = nullptr;
    Stmt* no = nullptr;  // may be null
    // The part of a class's pipeline behind its opacity: kernels of opacity alone leave it out.
    bool behind_opacity = false;
};
struct WhileStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::While;
    Expr* condition = nullptr;  // Bool
    Stmt* body = nullptr;
};
// for (init; condition; step) body. The init statements are Expression or Declare, and have the
// scope of the loop.
struct ForStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::For;
    std::span<Stmt*> init;
    Expr* condition = nullptr;  // Bool; null = for ever
    std::span<Expr*> step;
    Stmt* body = nullptr;
};
// break n; continue n. `loop` is the While, For, Illuminance or Gather statement that is meant.
struct BreakStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Break;
    int levels = 1;
    Stmt* loop = nullptr;  // checker
};
struct ContinueStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Continue;
    int levels = 1;
    Stmt* loop = nullptr;  // checker
};
// Inside functions only. May stand anywhere; value has the function's type, null in void functions.
struct ReturnStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Return;
    Expr* value = nullptr;
};
// illuminance([category,] position [, axis, angle] [, "name", value ...]) body: once per light
// record that reaches `position` within the cone; L, Cl, Ol are those of the record. Without axis:
// all around. The axis is a Vector (cast), the angle a Float.
struct IlluminanceStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Illuminance;
    Expr* category = nullptr;  // String, or null
    Expr* position = nullptr;  // Point
    Expr* axis = nullptr;
    Expr* angle = nullptr;
    std::span<Expr*> pairs;  // name, value, ...
    Stmt* body = nullptr;
    std::span<Expr*> args;  // as written, for printing; the checker sorts them into the above
};
// illuminate(position [, axis, angle]) body: a light shining from a point; sets L = Ps - position.
struct IlluminateStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Illuminate;
    Expr* position = nullptr;
    Expr* axis = nullptr;
    Expr* angle = nullptr;
    Stmt* body = nullptr;
};
// solar([axis, angle]) body: a light from infinitely far.
struct SolarStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Solar;
    Expr* axis = nullptr;
    Expr* angle = nullptr;
    Stmt* body = nullptr;
};
// gather(category, position, direction, angle, samples, "name", value ...) body [else missed]: the
// body once for each ray that hits something, `missed` once for each that does not. Pairs whose
// names are results (rsl/model/pairs.h) are variables that are set before.
struct GatherStmt : Stmt {
    static constexpr StmtKind kKind = StmtKind::Gather;
    std::span<Expr*> args;      // as written, checked: the five and the pairs
    Expr* category = nullptr;   // String
    Expr* position = nullptr;   // Point
    Expr* direction = nullptr;  // Vector
    Expr* angle = nullptr;      // Float, from the direction to the cone's side
    Expr* samples = nullptr;    // Float
    std::span<Expr*> pairs;
    Stmt* body = nullptr;
    Stmt* missed = nullptr;
};

// ---- definitions --------------------------------------------------------------------------------

// A user function, at file level or nested. Arguments are bound by reference if `output`, else by
// value (a write to one stays inside, with a warning).
struct Function {
    std::string_view name;
    std::string_view base;                               // the struct that a method comes from
    Type result;                                         // Void: none
    const StructDefinition* result_structure = nullptr;  // as Symbol::structure
    bool result_handle = false;                          // as Symbol::handle
    std::span<Symbol*> parameters;
    BlockStmt* body = nullptr;
    SourceSpan span;
    uint32_t id = 0;             // dense in the Ast
    Function* parent = nullptr;  // the function it is nested in; null also when in a shader's body
    bool called = false;         // checker: reached from a shader
    bool recursive = false;      // checker: on a circle of calls; each circle has at least one
    bool typed = true;           // its result type is written
    bool returns = false;        // a return with a value stands in it
    bool damaged = false;        // something of it was skipped after a syntax error
};

// struct NAME { members and methods }.
struct StructDefinition {
    std::string_view name;
    std::span<Symbol*> members;  // with their defaults
    std::span<Function*> methods;
    SourceSpan span;
};

// What a class has beside its parameters. expand_objects() makes the shader's body of it.
struct ClassDefinition {
    std::span<Stmt*> members;  // declarations, in order
    std::span<Function*> methods;
};

// Outputs that a shader names at run time: names beside values, resizable arrays.
struct NamedTable {
    Symbol* names = nullptr;
    Symbol* values = nullptr;
};
// A call that writes one; '*' stands for any text.
struct NamedWrite {
    std::string_view pattern;
    const CallExpr* call = nullptr;
};

struct ShaderDefinition {
    ShaderKind kind = ShaderKind::Surface;
    ClassDefinition* shader_class = nullptr;
    std::string_view name;
    std::span<Symbol*> parameters;
    BlockStmt* body = nullptr;
    SourceSpan span;
    std::span<Symbol*> handles =
        {};                  // parameters of type shader: variables, after expand_objects()
    bool co_shader = false;  // the renderer calls nothing of it: only other shaders do
    std::span<std::string_view> co_shaders = {};  // handles of those linked with it that it uses
    // Parameters of open length: those without elements are variables, and no parameters.
    std::span<Symbol*> open_arrays = {};
    // A class of which only construct(), begin() and displacement() run, whatever else it has.
    bool only_displaces = false;
    bool displaces = false;  // a surface of a class that has displacement() too
    std::span<NamedTable> named_tables = {};
    std::span<NamedWrite> named_writes = {};
};

// Memory of the nodes: blocks that live as long as the Ast.
class NodeArena {
  public:
    NodeArena();
    ~NodeArena();
    NodeArena(const NodeArena&) = delete;
    void* allocate(size_t bytes, size_t alignment);
    template <class T>
    T* make() {
        static_assert(std::is_trivially_destructible_v<T>);
        return new (allocate(sizeof(T), alignof(T))) T();
    }
    template <class T>
    std::span<T> copy(const std::vector<T>& items) {
        T* data = static_cast<T*>(allocate(items.size() * sizeof(T), alignof(T)));
        std::uninitialized_copy(items.begin(), items.end(), data);
        return {data, items.size()};
    }
    std::string_view copy(std::string_view text);

  private:
    std::vector<std::unique_ptr<std::byte[]>> blocks_;
    size_t used_ = 0;
    size_t size_ = 0;
};

// What lowering has said of a source: many kernels are made of one, with many copies of a function.
class ReportedOnce {
  public:
    // True the first time that this is said to the sink. Thread-safe.
    bool first(const Diagnostics& sink, const FindingInfo& info, Location where,
               const std::string& message) {
        std::lock_guard lock(mutex_);
        return said_.emplace(&sink, &info, where.file, where.begin, message).second;
    }

  private:
    std::mutex mutex_;
    std::set<std::tuple<const Diagnostics*, const FindingInfo*, FileId, uint32_t, std::string>>
        said_;
};

// One translation unit. Shaders made from it share it.
struct Ast {
    NodeArena arena;
    TokenStream tokens;                // with the pragmas
    std::vector<Function*> functions;  // at file level, in order
    std::vector<ShaderDefinition*> shaders;
    std::vector<StructDefinition*> structs;
    std::vector<std::string_view>
        pictures;                   // texts that calls name as pictures; set by the checker
    bool resizes = false;           // a call of resize(), push() or such stands in it
    bool resizable_arrays = false;  // a resizable array is declared
    uint32_t symbol_count = 0;      // of Symbol::id
    uint32_t function_count = 0;    // of Function::id
    uint32_t site_count = 0;        // of CallExpr::site
    mutable ReportedOnce reported;

    template <class Node>
    Node* make(SourceSpan span) {
        Node* node = arena.make<Node>();
        node->kind = Node::kKind;
        node->span = span;
        return node;
    }
};

// The node as its own type; the caller has looked at `kind`.
template <class Node, class Base>
auto& as(Base& node) {
    if constexpr (std::is_const_v<Base>)
        return static_cast<const Node&>(node);
    else
        return static_cast<Node&>(node);
}
template <class Node, class Base>
auto* as_if(Base* node) {
    using Result = std::conditional_t<std::is_const_v<Base>, const Node, Node>;
    return node && node->kind == Node::kKind ? static_cast<Result*>(node) : nullptr;
}

}  // namespace kinora::rsl
