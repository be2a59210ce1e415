// tests/rsl/random_shader_objects.cpp: resizable arrays, structs, classes and co-shaders at random.
#include "tests/rsl/shader_writer_p.h"

namespace kinora::rsl {

// A struct of members that expressions may use, with a method that changes them.
void ShaderWriter::structs() {
    line("struct Inner { float w = 0.5; color c = color(0.25, 0.5, 1); }");
    line("struct Both { vector v = 1; Inner inner; Inner other;");
    line("    void turn(float by) { v = v * by + vector(inner->w, by, 1); swap(); }");
    line("    void swap() { Inner kept = inner; inner = other; other->w += kept->w; } }");
    line("Inner mixed(Inner a; float by) { Inner r = a; r->w *= by; r->c += by; return r; }");
}

// A variable of struct type: its members are names like others.
void ShaderWriter::struct_declaration() {
    std::string name = fresh("o");
    line("Both " + name + ";");
    for (const char* member : {"inner", "other"}) {
        std::string path = name + "->" + member;
        scope_.push_back({path + "->w", BaseType::Float, -1, false, true});
        scope_.push_back({path + "->c", BaseType::Color, -1, false, true});
    }
    scope_.push_back({name + "->v", BaseType::Vector, -1, false, true});
    objects_.push_back(name);
}

// A statement on some struct in scope.
void ShaderWriter::struct_statement() {
    std::vector<std::string> seen;
    for (const Variable& v : scope_)
        for (const std::string& object : objects_)
            if (v.name == object + "->v") seen.push_back(object);
    if (seen.empty()) return struct_declaration();
    const std::string& a = seen[size_t(below(int(seen.size())))];
    const std::string& b = seen[size_t(below(int(seen.size())))];
    switch (below(4)) {
        case 0:
            return line(a + "->turn(" + value(BaseType::Float, 2) + ");");
        case 1:
            return line(a + "->inner = " + b + "->other;");
        case 2:
            return line(a + "->other = mixed(" + b + "->inner, " + value(BaseType::Float, 1) +
                        ");");
        default:
            return line(a + " = " + b + ";");
    }
}

// An array whose length changes, and what is in it at the end.
void ShaderWriter::resizable() {
    std::string name = fresh("g"), k = fresh("i");
    BaseType type = chance(60) ? BaseType::Float : BaseType::Color;
    line(std::string(type_name(type)) + " " + name + "[];");
    for (int n = 2 + below(4); n > 0; --n) {
        switch (below(5)) {
            case 0:
                line("resize(" + name + ", min(abs(" + value(BaseType::Float, 1) + "), 5));");
                break;
            case 1:
                line("if (" + condition(1) + ") push(" + name + ", " + value(type, 2) + ");");
                break;
            case 2:
                line("if (arraylength(" + name + ") > 1) " + name + "[0] = pop(" + name + ") + " +
                     name + "[0] * 0.5;");
                break;
            default:
                line("push(" + name + ", " + value(type, 2) + ");");
        }
    }
    std::string sum = fresh("x");
    line(std::string(type_name(type)) + " " + sum + " = 0; float " + k + ";");
    if (chance(15))
        line("for (" + k + " = 0; " + k + " < 70; " + k + " += 1) push(" + name + ", " +
             value(type, 1) + ");");
    if (chance(30))
        line("if (arraylength(" + name + ") >= 4) " + sum + " += " + type_name(type) + " spline(" +
             value(BaseType::Float, 1) + ", " + name + ");");
    if (chance(30))
        line("if (readprimvar(" +
             std::string(chance(50) ? "\"vary_one\"" : "concat(\"vary_\", \"two\")") + ", " + sum +
             ") == 0) " + sum + " = 1;");
    line("for (" + k + " = 0; " + k + " < arraylength(" + name + "); " + k + " += 1) " + sum +
         " += " + name + "[" + k + "];");
    scope_.push_back({sum, type, -1, false, true});
}

// A source of its own behind the line that shader_difference() parts them by.
void ShaderWriter::co_shader(const std::string& handle) {
    functions_.clear();  // those of the other source
    uses_structs_ = has_co_shaders_ = false;
    objects_.clear();
    line("//// " + handle);
    std::vector<Variable> members;
    std::string head = "class " + handle + "(";
    for (BaseType type : {BaseType::Float, BaseType::Color}) {
        std::string name = fresh("own_");
        head += std::string(type_name(type)) + " " + name + " = " + literal(type) + "; ";
        members.push_back({name, type, -1, true, false});
    }
    line(head + ") {");
    ++depth_;
    line("public float seen = " + literal(BaseType::Float) + ";");
    line("public color kept = " + literal(BaseType::Color) + ";");
    members.push_back({"seen", BaseType::Float, -1, false, true});
    members.push_back({"kept", BaseType::Color, -1, false, true});
    co_shader_method("public void begin() {", BaseType::Void, members, "");
    std::vector<Variable> all = members;
    all.push_back({"x", BaseType::Float, -1, false, false});
    all.push_back({"c", BaseType::Color, -1, false, false});
    co_shader_method("public float value(float x; color c;) {", BaseType::Float, all, "return ");
    all.back().writable = true;
    co_shader_method("public void change(float x; output color c;) {", BaseType::Void, all, "c = ");
    --depth_;
    line("}");
}

// The last statement gives the result, or sets what `last` begins with.
void ShaderWriter::co_shader_method(const std::string& head, BaseType result,
                                    const std::vector<Variable>& names, const std::string& last) {
    scope_ = names;
    calls_left_ = 0;
    UserFunction method{"", result, {}};
    line(head);
    ++depth_;
    inside_ = &method;
    statements(2 + below(3));
    if (!last.empty())
        line(last + value(result == BaseType::Void ? BaseType::Color : result, 2) + ";");
    inside_ = nullptr;
    --depth_;
    line("}");
}

// One handle, or another one at each point, or now and then none.
std::string ShaderWriter::some_co_shader() {
    std::string red = "getshader(\"red\")", green = "getshader(\"green\")";
    int dice = below(10);
    if (dice < 3) return chance(50) ? red : green;
    std::string other = dice < 9 ? green : "null";
    return "(" + condition(1) + ") ? " + red + " : " + other;
}

void ShaderWriter::co_shader_statement() {
    std::string h = fresh("h"), x = fresh("x"), c = fresh("c");
    line("shader " + h + " = " + some_co_shader() + ";");
    line("float " + x + " = " + h + "->value(" + value(BaseType::Float, 2) + ", " +
         value(BaseType::Color, 2) + ");");
    line("color " + c + " = " + value(BaseType::Color, 1) + ";");
    scope_.push_back({x, BaseType::Float, -1, false, true});
    scope_.push_back({c, BaseType::Color, -1, false, true});
    switch (below(4)) {
        case 0:
            return line(h + "->change(" + value(BaseType::Float, 2) + ", " + c + ");");
        case 1:
            return line(x + " += " + h + "->seen + getvar(" + h + ", " +
                        (chance(50) ? "\"kept\", " : "concat(\"ke\", \"pt\"), ") + c + ");");
        case 2:
            return line("if (" + h + " != null) " + c + " += " + h + "->kept;");
        default:
            return line(x + " += hasmethod(" + h + ", \"change\") + (" + h +
                        " == getshader(\"red\"));");
    }
}

// One of the above, as a statement among others.
void ShaderWriter::object_statement() {
    if (uses_structs_ && chance(60)) return struct_statement();
    resizable();
}

}  // namespace kinora::rsl
