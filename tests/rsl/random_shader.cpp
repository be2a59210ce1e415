// tests/rsl/random_shader.cpp: statements, functions and shaders at random.
#include "tests/rsl/random_shader.h"

#include "rsl/builtins/table.h"
#include "tests/rsl/shader_writer_p.h"

namespace kinora::rsl {

const ShaderPolicy kShaderPolicies[] = {
    //         ifs loops jumps arrays calls selects statements functions keep_all
    {"plain", 12, 8, 6, 8, 8, 6, 12, 1, false},  {"masks", 30, 6, 14, 6, 6, 25, 14, 1, false},
    {"spills", 3, 3, 2, 5, 4, 4, 30, 0, true},   {"loops", 10, 25, 14, 10, 6, 6, 14, 1, false},
    {"calls", 8, 6, 20, 6, 10, 5, 10, 3, false},
};
const int kShaderPolicyCount = int(std::size(kShaderPolicies));

std::string random_shader(uint64_t seed, bool all_rows) {
    return ShaderWriter(seed, all_rows).write();
}

ShaderWriter::ShaderWriter(uint64_t seed, bool all_rows)
    : random_{seed * 0x9e3779b97f4a7c15u + 1},
      policy_(kShaderPolicies[seed % uint64_t(kShaderPolicyCount)]) {
    for (int k = 0; k < 4; ++k) random_.next();
    int dice = below(100);
    kind_ = dice < 60   ? ShaderKind::Surface
            : dice < 73 ? ShaderKind::Displacement
            : dice < 86 ? ShaderKind::Light
            : dice < 92 ? ShaderKind::Volume
            : dice < 96 ? ShaderKind::Imager
                        : ShaderKind::Transformation;
    find_rows(all_rows);
}

void ShaderWriter::find_rows(bool all_rows) {
    bool maps = kind_ != ShaderKind::Displacement && chance(40);
    for (std::span<const Builtin> group : builtin_groups())
        for (const Builtin& row : group) {
            bool usable = row.lower && (row.legal >> int(kind_) & 1) != 0;
            if (!usable || (!row.ref.single && !all_rows)) continue;
            // The lengths of arrays change in statements of their own.
            if (row.effects & (kSetsLength | kReadsLength)) continue;
            if (row.effects & kForHeaders) continue;
            if (row.effects & kReadsChannels) continue;  // their arguments follow a list of names
            // Maps give their coordinates' slopes, which the reference does not know: a shader has
            // maps or takes derivatives.
            bool slopes = (row.effects & kDerivative) != 0, map = (row.effects & kService) != 0;
            if (slopes && map != maps) continue;
            std::map<BaseType, std::vector<Signature>> by_result;
            for (Signature& s : parse_signatures(row.signature))
                by_result[s.result.base].push_back(std::move(s));
            for (auto& [result, list] : by_result) rows_[result].push_back({&row, list});
        }
}

void ShaderWriter::line(const std::string& text) {
    written_.clear(), read_.clear();
    text_ += std::string(size_t(4 * depth_), ' ') + text + "\n";
}

// ---- the whole ----------------------------------------------------------------------------------

std::string ShaderWriter::write() {
    uses_structs_ = chance(25);
    is_class_ = kind_ == ShaderKind::Surface && chance(20);
    has_co_shaders_ = kind_ == ShaderKind::Surface && chance(15);
    if (uses_structs_) structs();
    for (int k = 0; k < policy_.functions; ++k) chance(20) ? recursion() : function();
    scope_.clear();
    calls_left_ = 5;
    line(shader_head());
    ++depth_;
    statements(policy_.statements);
    if (kind_ == ShaderKind::Light) {
        for (int k = 1 + below(2); k > 0; --k) light_source();
    } else if (kind_ == ShaderKind::Displacement) {
        line("P += " + value(BaseType::Vector, 2) + ";");
        line("N = calculatenormal(P);");
    } else if (kind_ == ShaderKind::Transformation) {
        line("P += " + value(BaseType::Vector, 2) + ";");
        line("N = " + value(BaseType::Normal, 2) + ";");
    } else {
        finish_surface();
    }
    --depth_;
    line(is_class_ ? "} }" : "}");
    if (has_co_shaders_)
        for (const char* handle : {"red", "green"}) co_shader(handle);
    return text_;
}

// Some parameters are bound to frame inputs, some to point inputs, some keep their defaults.
std::string ShaderWriter::shader_head() {
    std::string head = is_class_ ? "class fuzz(" : std::string(shader_kind_name(kind_)) + " fuzz(";
    auto add = [&](const char* detail, const char* stem) {
        BaseType type = chance(60) ? BaseType::Float : value_type();
        if (type == BaseType::Matrix || type == BaseType::String) type = BaseType::Color;
        std::string name = fresh(stem);
        bool saved = std::exchange(uniform_, true);
        head += std::string(detail) + type_name(type) + " " + name + " = " + literal(type) + "; ";
        uniform_ = saved;
        bool output = detail[0] == 'o';
        scope_.push_back({name, type, -1, detail[0] == ' ', output});
    };
    for (int k = below(3); k > 0; --k) add(" ", "frame_");
    for (int k = below(2); k > 0; --k) add(" ", "own_");
    if (kind_ != ShaderKind::Light)
        for (int k = below(3); k > 0; --k) add("varying ", "vary_");
    if (kind_ == ShaderKind::Surface)
        for (int k = below(2); k > 0; --k) add("output varying ", "aov_");
    return head +
           (is_class_ ? ") { public void surface(output color Ci; output color Oi;) {" : ") {");
}

void ShaderWriter::finish_surface() {
    line("Oi = " + value(BaseType::Color, 2) + ";");
    line("Ci = " + value(BaseType::Color, 3) + ";");
    for (size_t k = 0; k < scope_.size(); ++k) {
        const Variable v = scope_[k];
        bool used = policy_.keep_all || chance(40);
        if (!used || v.length >= 0) continue;
        if (v.type == BaseType::String)
            line("if (" + v.name + " == \"world\") Ci += 0.125;");
        else if (v.type == BaseType::Matrix)
            line("Ci += 0.125 * comp(" + v.name + ", 0, 1);");
        else
            line("Ci += 0.125 * color(" + v.name + ");");
    }
}

void ShaderWriter::function() {
    scope_.clear();
    calls_left_ = 2;
    UserFunction f{fresh("f"), chance(20) ? BaseType::Void : value_type(), {}};
    std::string head = std::string(type_name(f.result)) + " " + f.name + "(";
    for (int k = 1 + below(3); k > 0; --k) {
        BaseType type = value_type();
        bool output = chance(35) || (k == 1 && f.result == BaseType::Void);
        std::string name = fresh("a");
        head += std::string(output ? "output " : "") + type_name(type) + " " + name + "; ";
        f.arguments.push_back({{type, -1}, output});
        scope_.push_back({name, type, -1, false, output});
    }
    line(head + ") {");
    ++depth_;
    inside_ = &f;
    statements(3 + below(5));
    if (f.result != BaseType::Void) line("return " + value(f.result, 2) + ";");
    inside_ = nullptr;
    --depth_;
    line("}");
    functions_.push_back(f);
}

// Three turns at most; how many differs from point to point.
void ShaderWriter::recursion() {
    scope_.clear();
    calls_left_ = 0;
    UserFunction f{fresh("f"), value_type(), {}};
    if (f.result == BaseType::String) f.result = BaseType::Float;
    std::string a = fresh("a"), n = fresh("a"), type = type_name(f.result);
    scope_ = {{a, f.result, -1, false, false}, {n, BaseType::Float, -1, false, false}};
    f.arguments = {{{f.result, -1}, false}, {{BaseType::Float, -1}, false}};
    line(type + " " + f.name + "(" + type + " " + a + "; float " + n + ";) {");
    ++depth_;
    inside_ = &f;
    statements(below(3));
    line("if (!(" + n + " > 0)) return " + value(f.result, 2) + ";");
    line(type + " x = " + f.name + "(" + value(f.result, 2) + ", min(" + n + ", 3) - 1);");
    scope_.push_back({"x", f.result, -1, false, true});
    statements(below(3));
    line("return " + value(f.result, 2) + ";");
    inside_ = nullptr;
    --depth_;
    line("}");
    functions_.push_back(f);
}

// ---- statements ---------------------------------------------------------------------------------

void ShaderWriter::statements(int count) {
    for (int k = 0; k < count; ++k) statement();
}

void ShaderWriter::statement() {
    int dice = below(100);
    auto takes = [&](int share) {
        dice -= share;
        return dice < 0;
    };
    bool deep = depth_ > 3;
    if (takes(policy_.ifs) && !deep) return branch();
    if (takes(policy_.loops) && !deep) return chance(60) ? counted_loop() : while_loop();
    if (takes(policy_.jumps)) return jump();
    if (takes(policy_.arrays)) return array_declaration();
    if (takes(policy_.calls)) return void_call();
    if (takes(5)) return light_loop();
    if (takes(uses_structs_ ? 10 : 2)) return object_statement();
    if (has_co_shaders_ && !inside_ && takes(12)) return co_shader_statement();
    if (takes(28)) return declaration();
    assignment();
}

// A block in braces whose names end with it.
void ShaderWriter::body(int most) {
    size_t outer = scope_.size();
    ++depth_;
    statements(1 + below(most));
    --depth_;
    scope_.resize(outer);
}

void ShaderWriter::declaration() {
    BaseType type = value_type();
    bool uniform = chance(15) && type != BaseType::String;
    std::string name = fresh(uniform ? "u" : "x");
    bool saved = std::exchange(uniform_, uniform);
    line((uniform ? "uniform " : "") + std::string(type_name(type)) + " " + name + " = " +
         value(type, 3) + ";");
    uniform_ = saved;
    scope_.push_back({name, type, -1, uniform, true});
}

void ShaderWriter::array_declaration() {
    BaseType type = chance(60) ? BaseType::Float : BaseType::Color;
    int length = chance(60) ? 4 + below(3) : 1 + below(3);
    std::string items;
    for (int k = 0; k < length; ++k) items += (k ? ", " : "") + value(type, 1);
    std::string name = fresh("r");
    line(std::string(type_name(type)) + " " + name + "[" + std::to_string(length) + "] = {" +
         items + "};");
    scope_.push_back({name, type, length, false, true});
}

auto ShaderWriter::variable(BaseType type, bool writable, bool array, int shortest) -> Variable* {
    std::vector<Variable*> fits;
    for (Variable& v : scope_) {
        bool right = (v.type == type || type == BaseType::Invalid) &&
                     (array ? v.length >= shortest : v.length < 0);
        bool fresh = writable || !is_in(written_, v.name);
        if (right && fresh && (v.writable || !writable) && (v.uniform || !uniform_ || writable))
            fits.push_back(&v);
    }
    return fits.empty() ? nullptr : fits[size_t(below(int(fits.size())))];
}

// For an output argument. What is written and used in one statement has no order.
auto ShaderWriter::output_variable(BaseType type, bool array, int shortest) -> Variable* {
    Variable* v = variable(type, true, array, shortest);
    if (!v || v->uniform) return nullptr;
    if (is_in(written_, v->name) || is_in(read_, v->name)) return nullptr;
    written_.push_back(v->name);
    return v;
}

void ShaderWriter::assignment() {
    static const char* const kOps[] = {"=", "=", "+=", "-=", "*="};
    if (chance(20)) {  // a global
        std::vector<const GlobalInfo*> fits;
        for (const GlobalInfo& g : globals()) {
            bool of_light = g.name == "L" || g.name == "Cl" || g.name == "Ol";
            if ((g.writers & in_kind(kind_)) && (!of_light || in_illuminate_)) fits.push_back(&g);
        }
        if (!fits.empty()) {
            const GlobalInfo& g = *fits[size_t(below(int(fits.size())))];
            line(std::string(g.name) + " = " + value(g.type.base, 3) + ";");
            return;
        }
    }
    bool array = chance(15);
    Variable* found = variable(BaseType::Invalid, true, array);
    if (!found) return declaration();
    Variable v = *found;
    read_.push_back(v.name);
    bool saved = std::exchange(uniform_, v.uniform);
    const char* op = v.type == BaseType::String   ? "="
                     : v.type == BaseType::Matrix ? "="
                                                  : one_of(kOps);
    std::string target = v.name;
    if (array) target += "[" + value(BaseType::Float, 1) + "]";
    BaseType type = v.type;
    if (is_triple(type) && !array && chance(15)) {  // one component
        target += "[" + value(BaseType::Float, 0) + "]";
        type = BaseType::Float;
    }
    line(target + " " + op + " " + value(type, 3) + ";");
    uniform_ = saved;
}

void ShaderWriter::branch() {
    line("if (" + condition(2) + ") {");
    body(4);
    if (chance(45)) {
        line("} else {");
        body(3);
    }
    line("}");
}

// The bound is a number, a uniform or, often, differs from point to point.
void ShaderWriter::counted_loop() {
    std::string i = fresh("i");
    line("float " + i + ";");
    std::string limit = chance(50) ? std::to_string(1 + below(4))
                                   : "min(abs(" + value(BaseType::Float, 2) + "), 4)";
    line("for (" + i + " = 0; " + i + " < " + limit + "; " + i + " += 1) {");
    scope_.push_back({i, BaseType::Float, -1, false, false});
    loop_kinds_.push_back('f');
    body(4);
    loop_kinds_.pop_back();
    line("}");
}

void ShaderWriter::while_loop() {
    std::string i = fresh("i");
    line("float " + i + " = 0;");
    scope_.push_back({i, BaseType::Float, -1, false, false});
    line("while (" + condition(1) + " && " + i + " < 4) {");
    ++depth_;
    line(i + " += 1;");
    --depth_;
    loop_kinds_.push_back('w');
    body(4);
    loop_kinds_.pop_back();
    line("}");
}

void ShaderWriter::light_loop() {
    bool sees_lights = kind_ == ShaderKind::Surface || kind_ == ShaderKind::Volume;
    if (!sees_lights || in_illuminance_ || depth_ > 3) return assignment();
    std::string cone = chance(60) ? ", " + value(BaseType::Vector, 1) + ", " +
                                        (chance(50) ? "PI / 2" : value(BaseType::Float, 1))
                                  : "";
    std::string category = chance(20) ? (chance(50) ? "\"key\", " : "\"-fill\", ") : "";
    line("illuminance(" + category + (chance(80) ? "P" : value(BaseType::Point, 1)) + cone + ") {");
    in_illuminance_ = true;
    loop_kinds_.push_back('i');
    body(4);
    loop_kinds_.pop_back();
    in_illuminance_ = false;
    line("}");
}

// Under a condition, so that code after it is reached.
void ShaderWriter::jump() {
    bool can_return = inside_ != nullptr;
    if (can_return && (chance(60) || !in_loop())) {
        bool nothing = inside_->result == BaseType::Void;
        line("if (" + condition(1) + ") return" + (nothing ? "" : " " + value(inside_->result, 2)) +
             ";");
        return;
    }
    if (!in_loop()) return assignment();
    int levels = loop_kinds_.size() > 1 && chance(40) ? 2 : 1;
    std::string count = levels > 1 ? " 2" : "";
    line("if (" + condition(1) + ") " + (chance(50) ? "break" : "continue") + count + ";");
}

void ShaderWriter::void_call() {
    if (chance(40)) {
        std::string call = user_call(BaseType::Void, 2);
        if (!call.empty()) return line(call + ";");
    }
    std::string call = row_call(BaseType::Void, 2);
    if (!call.empty()) return line(call + ";");
    assignment();
}

void ShaderWriter::light_source() {
    bool solar = chance(40);
    std::string cone =
        chance(60) ? value(BaseType::Vector, 1) + ", " + value(BaseType::Float, 1) : "";
    if (solar)
        line("solar(" + cone + ") {");
    else
        line("illuminate(" + value(BaseType::Point, 1) + (cone.empty() ? "" : ", ") + cone + ") {");
    in_illuminate_ = true;
    body(3);
    ++depth_;
    line("Cl = " + value(BaseType::Color, 3) + ";");
    --depth_;
    in_illuminate_ = false;
    line("}");
}

}  // namespace kinora::rsl
