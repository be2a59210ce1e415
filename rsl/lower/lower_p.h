// rsl/lower/lower_p.h: the state of lowering one kernel, shared by the lower_*.cpp files and the
// built-ins.
//
// Variables are SSA values in slots. A branch (guarded) runs its body in an If and merges the slots
// that changed, which a trail of old values tells; a loop carries the slots that ChangeFinder finds
// in its body. `running` (Emitter) is the mask of the lanes that execute; break, continue and
// return take lanes out of it, after which the rest of each block stands in an If of its own.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jit/ir/kernel.h"
#include "rsl/lower/lower.h"
#include "rsl/lower/math.h"
#include "rsl/model/builtin.h"
#include "rsl/model/changes.h"
#include "rsl/text/findings.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

class Lowering;

// ".x" of a point, ".r" of a color, ".7" of a matrix, "" of a float.
std::string component_suffix(BaseType type, int component);

inline jit::Type ir_type(BaseType type) {
    return type == BaseType::String ? jit::Type::I
           : type == BaseType::Bool ? jit::Type::M
                                    : jit::Type::F;
}

// Where an l-value is: a slot, or an element of an array; perhaps one component of it.
struct Target {
    BaseType type = BaseType::Void;  // of the slot or element
    int slot = -1;                   // -1: an element of `array`
    int array = -1;                  // index in Lowering's arrays
    Value index = jit::kNone;        // element, int
    Value component = jit::kNone;    // int 0..2, or none: all

    // Is it a whole variable that may stand for this parameter?
    bool lends(const Symbol& parameter) const {
        return slot >= 0 && component == jit::kNone && type == parameter.type.base;
    }
};

// A call to a built-in: what its row's `lower` function sees. It sets `result` (of the type that
// the overload says) and the outputs.
struct LowerCall {
    Lowering& low;
    jit::Builder& b;
    const CallExpr& call;
    std::vector<Lowered> args;    // values; of outputs, before the call; pairs are not among them
    std::vector<Target> targets;  // of output arguments
    std::vector<std::pair<std::string, Lowered>> pairs;
    std::vector<std::pair<std::string, Target>> output_pairs;  // variables that pairs name
    Lowered result;

    int overload() const { return call.signature->overload; }
    BaseType result_type() const { return call.type.base; }
    Value f(int i) const { return args[size_t(i)].c[0]; }
    V3 v3(int i) const { return args[size_t(i)].v3(); }
    void set_output(int i, const Lowered& value);
    void set(Value x) { result = lowered(result_type(), x); }
    void set(const V3& v) { result = lowered(result_type(), v); }
    // The text of a string argument, or null if it is not known at compile time (then reported).
    const std::string* text(int i) const;
    bool has_pair(std::string_view name) const;
    // The value of a pair that the callee's row of optional parameters has (rsl/model/pairs.h).
    Value pair(std::string_view name, float otherwise) const;
    Value text_pair(std::string_view name) const;  // its string id, that of "" if absent
    // Reports pairs that the callee does not know (rsl/model/pairs.h): they have no effect.
    void report_unknown_pairs() const;
    Target* output_pair(std::string_view name);  // null if absent
    const Location& where() const { return call.span.where; }
};

class Lowering : public Emitter {
  public:
    Lowering(jit::Builder& builder, const LowerOptions& lower_options, Diagnostics& sink,
             LoweredShader& result)
        : Emitter(builder, lower_options.math),
          options(lower_options),
          diagnostics(sink),
          out(result) {
        slots_.resize(size_t(Global::Count));
    }

    const LowerOptions& options;
    Diagnostics& diagnostics;
    LoweredShader& out;
    const Layer* layer = nullptr;
    size_t layer_index = 0;
    ShaderKind kind() const { return layer->shader->kind; }
    const Ast& ast() const { return *layer->shader->ast; }

    // Null if that has been said of the source.
    template <class... Args>
    Finding* report(const FindingInfo& info, Location where, const Args&... args) {
        std::string message = fmt::vformat(info.text, fmt::make_format_args(args...));
        if (!ast().reported.first(diagnostics, info, where, message)) return nullptr;
        return &diagnostics.add(info, where, std::move(message));
    }
    template <class... Args>
    void error(const FindingInfo& info, Location where, const Args&... args) {
        report(info, where, args...);
        failed = true;
    }
    bool failed = false;

    // lower.cpp: one shader of the stack.
    void run_layer(const Layer& next);
    void declare_layer(const Layer& next);    // a layer that is done: its parameters only
    Lowered parameter(const Symbol& symbol);  // its first value
    // What displacements that bend normals were given, to tell whether they changed it.
    Lowered given_N, given_P;

    // variables.cpp, inputs.cpp: slots, arrays, targets.
    Lowered read(const Symbol& symbol);
    Lowered read_global(Global id);
    Lowered smooth_P(const Lowered& N);
    V3 normal_of(const V3& p);  // Du(p) ^ Dv(p), oriented as Ng; slopes as those of N
    void write_slot(int slot, const Lowered& value);
    Lowered read_slot(int slot) { return slots_[size_t(slot)].value; }
    bool live(Global id) const { return slots_[size_t(id)].live; }
    void kill(Global id) { slots_[size_t(id)].live = false; }
    int slot_of(const Symbol& symbol) const;
    int new_slot(const Lowered& value);
    void free_slot(int slot) { slots_[size_t(slot)].live = false; }
    Target target(const Expr& expr);
    Lowered load(const Target& t);
    void store(const Target& t, const Lowered& value);
    void declare(const Symbol& symbol);
    void end_scope(std::span<Stmt* const> body);
    std::vector<Lowered> array_values(const Expr& array);  // all elements
    void set_array(const Expr& array, std::span<const Lowered> values);
    Lowered zero(BaseType type);
    Lowered global_input(Global id);  // in the layer's "current"
    Lowered input(const std::string& name, BaseType type, jit::Rate rate,
                  const std::string& du = "", const std::string& dv = "");
    Value scalar_input(const std::string& name, jit::Type type, jit::Rate rate);
    // Is v exactly the global's unmodified input?
    bool is_input(const V3& v, const char* name);

    // expressions.cpp
    Lowered expr(const Expr& e);
    Value value(const Expr& e) { return expr(e).c[0]; }
    Lowered convert(const Lowered& x, BaseType to);
    Lowered binary(Op op, const Lowered& x, const Lowered& y);
    Lowered call_builtin(const CallExpr& e);
    Lowered call_function(const CallExpr& e);

    // recursion.cpp: functions that call themselves are functions of the IR.
    struct CallArguments {
        std::vector<Lowered> values;
        std::vector<Target> targets;  // of output parameters
        std::vector<int> arrays;      // of array parameters, else -1
    };
    Lowered call_recursive(const CallExpr& e, const CallArguments& arguments);
    const std::string* constant_text(Value string_id);
    // Says so where an optional parameter is known and changes nothing.
    void report_idle_pair(std::string_view callee, std::string_view name, const Lowered& value,
                          Location where);

    // control.cpp
    void statement(const Stmt& stmt);
    void evaluate(const Expr& e);
    void block(std::span<Stmt* const> body);
    // Runs body() for the lanes of `mask` (a part of running) and merges what it changed.
    template <class Body>
    void guarded(Value mask, Body&& body);
    struct Loop {
        const Stmt* stmt;
        int broken = -1;  // slots of masks, -1 if the loop has no such jump
        int continued = -1;
    };
    // Opens the variables that a loop carries: call right after begin_loop; close() right before
    // end_loop gives their next values, out() after it leaves the last ones in the slots.
    struct Carried {
        std::vector<int> slots;
        std::vector<Value> vars;
    };
    Carried open_carried(std::vector<int> slots);
    void close_carried(const Carried& carried, std::vector<Value>& next);
    void carried_out(const Carried& carried);
    std::vector<int> carried_slots(const Changes& changes);
    Loop begin_jumps(const Stmt& stmt, const Changes& changes);
    // Can a lane that enters the body of the innermost loop fail to reach its end?
    bool leaves_loop(const Changes& changes);
    // `entered` without the lanes that went further out than the loop just closed.
    Value after_loop(const Changes& changes, Value entered);
    template <class Condition, class Body, class Step>
    void run_loop(const Stmt& stmt, const Changes& changes, Condition&& condition, Body&& body,
                  Step&& step);
    int loop_site(const Stmt& stmt);

    // gather.cpp
    void gather(const GatherStmt& stmt);
    struct GatherResults;
    void gather_turn(const GatherStmt& stmt, Value set, Value record, GatherResults& results,
                     bool shoots);
    void gather_branch(const GatherStmt& stmt, Value set, Value record, GatherResults& results,
                       bool hit);
    int gather_depth_ = 0;

    // lights.cpp
    void illuminance(const IlluminanceStmt& stmt);
    // The statement's loop over the records of a set: `turn` lowers its body for one.
    void replay(const Stmt& stmt, Value set, const std::function<void(Value record)>& turn);
    void illuminate(const Stmt& stmt, const Expr* position, const Expr* axis, const Expr* angle,
                    const Stmt& body);
    void begin_light(const Changes& changes);
    void light_outputs();
    struct Cone;
    Cone cone(const Expr* axis, const Expr* angle);
    Value inside(const Cone& cone, const V3& L);
    void light_body(const IlluminanceStmt& stmt, Value set, Value record, const Cone& around,
                    const Lowered& position);
    void light_pairs(const IlluminanceStmt& stmt);
    Value category_matches(Value set, Value record, const Expr& category);
    // Calls body(record) for each record of a set, inside a Loop whose counter agrees in all lanes;
    // `carried` are plain values that body may replace.
    template <class Body>
    void for_each_record(Value set, std::span<Value> carried, Location where, Body&& body);
    Value record_set(const V3& position);
    Value record_field(Value set, Value record, int column, jit::Type type = jit::Type::F);
    V3 record_triple(Value set, Value record, int column);
    Value record_uniform(Value set, Value record, int field, jit::Type type);
    int message_column(std::string_view name, Type type, int* index);
    // The light's parameter where it has one, else `before`; *known says where.
    std::vector<Lowered> light_message(const std::string& name, Type type,
                                       std::span<const Lowered> before, Value* known);
    bool in_solar = false;           // inside a light's solar
    Value current_set = jit::kNone;  // inside illuminance
    Value current_record = jit::kNone;

    // spaces.cpp. A matrix of four rows for row vectors; `to_current` or `from_current`.
    struct Space {
        bool identity = true;
        Lowered to_current, from_current;
    };
    Space space(Value name, Location where);
    bool is_affine(const Lowered& m);                   // known to be
    V3 transform_point(const V3& p, const Lowered& m);  // divided by w unless m is affine
    V3 transform_vector(const V3& v, const Lowered& m);
    V3 transform_normal(const V3& n, const Lowered& inverse);  // by the transpose of the inverse
    Lowered multiply(const Lowered& a, const Lowered& m);
    Lowered invert(const Lowered& m);
    Value determinant(const Lowered& m);
    // Out of the space into current, or the other way, as the type of x does it.
    Lowered to_current(const Lowered& x, const Space& from);
    Lowered from_current(const Lowered& x, const Space& to);
    // A displacement's "current" is the object's space. Where it is joined with surfaces, the
    // kernel's is the camera's: what it reads is brought over, and what it leaves is brought back.
    bool bends_normals() const;
    Lowered into_layer(const Lowered& x);  // the kernel's current -> the layer's
    Lowered out_of_layer(const Lowered& x);
    Lowered from_object(const Lowered& x);  // what the mesh brings, in the layer's current
    Lowered color_space(const Lowered& color, std::string_view from, std::string_view to,
                        Location where);

    // Derivatives of all components.
    V3 du(const V3& v);
    V3 dv(const V3& v);

    // Number of this call of random(): its place, the functions it stands in and the loop counters.
    Value random01(const CallExpr& call, int component);
    std::vector<Value> loop_counters;
    // The functions inlined around here: inline_path, or path_handed_in * path_factor + inline_path
    // inside a function of the IR.
    uint32_t inline_path = 0;
    Value path_handed_in = jit::kNone;
    uint32_t path_factor = 1;
    Value path_value();
    void enter_path(uint32_t site);
    // The ints that seed a call's samples: the point's, and this place's with its loop iterations.
    std::array<Value, 2> sample_seed(uint32_t site);

    std::vector<Value> service(Service service, std::span<const Value> args);

    // Parameters of layers that are done, for displacement() and surface().
    struct Message {
        ShaderKind from;
        std::string name;
        Type type;
        Lowered value;
        int array = -1;  // index in Lowering's arrays
    };
    std::vector<Message> messages;
    // The elements of a message, plain numbers; one if it is no array.
    std::vector<Lowered> message_values(const Message& message);
    std::span<const Layer> layers;  // the whole stack

  private:
    struct Slot {
        bool live = false;
        Lowered value;
    };
    struct Array {
        BaseType element = BaseType::Float;
        int length = 0;
        int first_slot = -1;      // elements as values
        std::vector<int> memory;  // arrays of the IR, one a component
        std::vector<int> inputs;  // first input of each component: a parameter never written
    };
    struct Undo {
        int slot;
        Slot old;
    };
    struct FunctionFrame {
        const rsl::Function* function = nullptr;
        int returned;  // slot of a mask
        int result;    // slot, -1 for void
    };

    void enter_layer();  // slots for the symbols of `layer`
    void merge_changes(size_t mark, Value mask, Value outer_running);
    int array_of(const Symbol& symbol);
    int make_array(const Symbol& symbol, Type type);
    int parameter_array(const Symbol& symbol);
    Lowered load_element(int array, Value index);
    void store_element(int array, Value index, const Lowered& value);
    void fill_array(int array, const Expr* initial);
    void check_index(Value index_float, int length, Location where);
    bool as_product(const Expr& e, BaseType type, Lowered& x, Lowered& y);
    Lowered sum(const BinaryExpr& e);
    Lowered select_expr(const SelectExpr& e);
    Lowered logical_expr(const BinaryExpr& e);
    bool runs_apart(std::initializer_list<const Expr*> sides, uint32_t effects) const;
    // body() where a value is asked for only if `condition` is `when`.
    template <class Body>
    auto asking(Value condition, bool when, Body&& body);
    Lowered assign(const AssignExpr& e);
    Lowered cast(const CastExpr& e);
    Lowered sum_of(Op op, const Lowered& x, const Expr& right);
    Value compare(Op op, const Lowered& x, const Lowered& y);
    void branch(const IfStmt& stmt);
    void loop(const Stmt& stmt);
    void run_statements(std::span<Stmt* const> body);
    void jump(const Stmt* loop_stmt, bool leaves);
    Lowered run_function(const rsl::Function& f);
    struct Outside {
        const Symbol* symbol;  // null: a global that no name in the function means
        Global id;             // then
        int array_length;      // -1: no array
        bool written;
    };
    struct Recursive {
        const rsl::Function* function;
        std::vector<int> lengths;  // of array parameters, else -1
        bool lit;                  // called from inside illuminance
        size_t index;              // in the module
        std::vector<Outside> outside;
        bool random, record;
    };
    struct Activation;
    size_t recursive_function(const CallExpr& e, const CallArguments& arguments);
    void write_recursive(const Recursive& r);
    void find_outside(Recursive& r, const CallExpr& e);
    Lowered read_outside(const Outside& outside);
    int outside_slot(const Outside& outside) const;
    void store_outside(const Outside& outside, const std::vector<Lowered>& values);
    std::vector<Lowered> outside_values(const Outside& outside);
    bool may_grow(const CallExpr& e);
    int array_argument(const CallExpr& e, size_t k);
    void return_from(const ReturnStmt& stmt);
    Space kernel_space(Value name, Location where);  // in terms of the kernel's current
    Space input_space(const std::string& name);
    Space variable_space(Value name);
    void unknown_space(const std::string& name, Location where);
    Lowered change_space(const Lowered& x, bool identity, const Lowered& m, const Lowered& inverse);
    const ParamBinding* binding(std::string_view name) const;
    Lowered bound_value(const ParamBinding& bound, std::string_view name, Type type, int element);
    Lowered bound_input(const ParamBinding& bound, std::string_view name, Type type, int element);
    Lowered kernel_input(Global id);
    jit::InputInfo element_input(std::string_view name, BaseType type, const ParamBinding& bound,
                                 int element, int component);
    Value pick(const V3& v, Value component);
    bool check_size(const Symbol& symbol, Type type);

    std::vector<Slot> slots_;
    std::vector<Undo> trail_;
    std::vector<int> seen_;  // by slot: the merge that met it last
    int merge_number_ = 0;
    int symbol_base_ = int(Global::Count);  // slot of symbol 0 of this layer's Ast
    std::vector<int> array_of_;             // by Symbol::id, -1: none yet
    std::vector<int> lent_slot_;  // by Symbol::id: an output parameter's argument; -1: its own
    std::vector<Array> arrays_;
    int64_t array_bytes_ = 0;         // of them all, for 16 points
    std::vector<uint8_t> in_memory_;  // by Symbol::id
    std::vector<Loop> loops_;
    std::vector<FunctionFrame> frames_;
    struct LightSource {
        const Stmt* stmt;
        int L, Cl, Ol, lit;        // slots
        Lowered left_Cl, left_Ol;  // as the statement left the globals
    };
    std::vector<LightSource> light_sources_;
    std::vector<Recursive> recursive_;
    Value call_depth_ = jit::kNone;  // calls of recursive functions around; none outside them
    int calls_left_ = -1;            // slot: how many more such calls this one may make
    bool in_loop_ = false;
    // Conditions of ?:, && and || around, whose other side all running lanes compute though not all
    // ask for it: only those that do report faults.
    struct Asked {
        Value condition;
        bool when;
    };
    std::vector<Asked> asked_;
    // The lanes of the innermost If or Loop. Where a statement begins, running is the same.
    Value region_ = running;
    Location where_;
};

template <class Body>
void Lowering::guarded(Value mask, Body&& body) {
    bool known;
    if (b.constant_m(mask, &known) && !known) return;
    if (mask == region_) return body();
    Value outer = running, outer_region = std::exchange(region_, mask);
    size_t mark = trail_.size();
    b.begin_if(mask);
    running = mask;
    body();
    b.end_if();
    region_ = outer_region;
    merge_changes(mark, mask, outer);
}

template <class Body>
auto Lowering::asking(Value condition, bool when, Body&& body) {
    asked_.push_back({condition, when});
    auto result = body();
    asked_.pop_back();
    return result;
}

template <class Body>
void Lowering::for_each_record(Value set, std::span<Value> carried, Location where, Body&& body) {
    Value count = b.op(jit::Op::RecordCount, set);
    Value enter = b.op(jit::Op::ILt, b.i(0), count);
    int site = b.fault_site(where, "more lights than a loop may visit");
    b.begin_loop(enter, site);
    Value record = b.loop_var(b.i(0));
    std::vector<Value> vars, next;
    for (Value& v : carried) vars.push_back(v = b.loop_var(v));
    body(record);
    next.push_back(b.iadd(record, b.i(1)));
    next.insert(next.end(), carried.begin(), carried.end());
    b.end_loop(b.op(jit::Op::ILt, next[0], count), next);
    for (size_t i = 0; i < vars.size(); ++i) carried[i] = b.loop_out(vars[i]);
}

}  // namespace kinora::rsl
