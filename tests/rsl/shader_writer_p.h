// tests/rsl/shader_writer_p.h: the state of the random-shader generator, shared by its three files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rsl/model/builtin.h"
#include "rsl/model/globals.h"
#include "tests/rsl/differential.h"
#include "tests/rsl/random_shader.h"

namespace kinora::rsl {

class ShaderWriter {
  public:
    ShaderWriter(uint64_t seed, bool all_rows);
    std::string write();

  private:
    struct Variable {
        std::string name;
        BaseType type;
        int length = -1;  // of an array
        bool uniform = false;
        bool writable = true;
    };
    struct UserFunction {
        std::string name;
        BaseType result;
        std::vector<Signature::Argument> arguments;
    };
    // The overloads of one row that give one type.
    struct Callable {
        const Builtin* row;
        std::vector<Signature> signatures;
    };

    int below(int n) { return int(random_.next() % uint32_t(n)); }
    bool chance(int percent) { return below(100) < percent; }
    template <size_t N>
    const char* one_of(const char* const (&list)[N]) {
        return list[below(int(N))];
    }
    std::string fresh(const char* stem) { return stem + std::to_string(names_++); }
    void line(const std::string& text);

    // random_shader.cpp
    void find_rows(bool all_rows);
    void function();
    void recursion();
    void parameters();
    std::string shader_head();
    void finish_surface();
    void statements(int count);
    void statement();
    void body(int most);
    void declaration();
    void array_declaration();
    void assignment();
    void branch();
    void counted_loop();
    void while_loop();
    void light_loop();
    void jump();
    void void_call();
    void light_source();
    Variable* output_variable(BaseType type, bool array, int shortest);
    Variable* variable(BaseType type, bool writable, bool array, int shortest = 1);
    static bool is_in(const std::vector<std::string>& list, const std::string& name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    }
    const std::string& read(const Variable& v) {
        read_.push_back(v.name);
        return v.name;
    }
    bool in_loop() const { return !loop_kinds_.empty(); }

    // random_shader_objects.cpp
    void structs();
    void struct_declaration();
    void struct_statement();
    void resizable();
    void object_statement();
    void co_shader(const std::string& handle);
    void co_shader_method(const std::string& head, BaseType result,
                          const std::vector<Variable>& names, const std::string& last);
    std::string some_co_shader();
    void co_shader_statement();

    // random_shader_expressions.cpp
    BaseType value_type();
    std::string value(BaseType type, int depth);
    std::string leaf(BaseType type);
    std::string literal(BaseType type);
    std::string arithmetic(BaseType type, int depth);
    std::string spatial(BaseType type, int depth);
    std::string composed(BaseType type, int depth);
    std::string select(BaseType type, int depth);
    std::string element(BaseType type, int depth);
    std::string condition(int depth);
    std::string row_call(BaseType type, int depth);
    std::string user_call(BaseType type, int depth);
    bool arguments(const Builtin& row, const Signature& signature, int depth, std::string& text);
    bool argument(const Builtin& row, const Signature::Argument& argument, int depth,
                  std::string& text);
    std::string text_for(std::string_view row);

    Random random_;
    const ShaderPolicy& policy_;
    ShaderKind kind_ = ShaderKind::Surface;
    std::map<BaseType, std::vector<Callable>> rows_;
    std::vector<Variable> scope_;
    std::vector<UserFunction> functions_;
    std::vector<char> loop_kinds_;  // 'f' for, 'w' while, 'i' illuminance, innermost last
    // By the statement being written: what calls write is not read or written elsewhere in it.
    std::vector<std::string> written_, read_;
    const UserFunction* inside_ = nullptr;
    std::vector<std::string> objects_;  // variables of struct type
    bool uses_structs_ = false;
    bool is_class_ = false;
    bool has_co_shaders_ = false;  // "red" and "green", of the same methods
    bool uniform_ = false;         // only uniform values may be written
    bool in_illuminance_ = false, in_illuminate_ = false;
    int depth_ = 0;       // of blocks
    int calls_left_ = 0;  // of user functions, which are expanded where they are called
    int names_ = 0;
    std::string text_;
};

}  // namespace kinora::rsl
