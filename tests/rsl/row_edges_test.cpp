// tests/rsl/row_edges_test.cpp: every overload of every built-in row over random and edge values:
// the same bits on every target, in what it returns, writes and tells the renderer.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rsl/builtins/table.h"
#include "rsl/model/pairs.h"
#include "tests/rsl/edge_world.h"
#include "tests/rsl/shader_difference.h"
#include "tests/rsl/shading_world.h"

namespace kinora::rsl {
namespace {

constexpr size_t kPoints = 165;  // no whole number of lane groups

struct Text {
    std::string_view row;
    BaseType written;  // the variable behind it; Invalid: any
    std::vector<const char*> texts;
};
// What the literals of a call are: the last text serves all that follow.
const std::vector<Text>& texts() {
    static const std::vector<Text> kTexts = {
        {"ctransform", BaseType::Invalid, {"hsv"}},
        {"spline", BaseType::Invalid, {"bspline"}},
        {"area", BaseType::Invalid, {"shading"}},
        {"format", BaseType::Invalid, {"%f %c %p %v %n %m %s"}},
        {"printf", BaseType::Invalid, {"%f %c %p %v %n %m %s"}},
        {"match", BaseType::Invalid, {"w.*d", "world"}},
        {"shadername", BaseType::Invalid, {"displacement"}},
        {"textureinfo", BaseType::String, {"a.tex", "type"}},
        {"textureinfo", BaseType::Matrix, {"a.tex", "viewingmatrix"}},
        {"textureinfo", BaseType::Invalid, {"a.tex", "resolution"}},
        {"bake3d", BaseType::Invalid, {"a.ptc", "value,tint"}},
        {"occlusion", BaseType::Invalid, {"a.sm"}},
    };
    return kTexts;
}

// Optional parameters and a value for each; `a` is a varying float.
constexpr std::pair<const char*, const char*> kOptions[] = {
    {"samples", "a"},
    {"samplecone", "a"},
    {"bias", "a"},
    {"maxdist", "a"},
    {"coneangle", "a"},
    {"falloff", "a"},
    {"falloffmode", "a"},
    {"source", "a"},
    {"gapbias", "a"},
    {"blur", "a"},
    {"sblur", "a"},
    {"tblur", "a"},
    {"width", "a"},
    {"swidth", "a"},
    {"twidth", "a"},
    {"fill", "a"},
    {"filter", "\"gaussian\""},
    {"label", "\"label\""},
    {"radius", "a"},
    {"coordsystem", "\"world\""},
    {"estimator", "a"},
    {"environmentmap", "\"a.env\""},
};

// A surface that calls one overload with parameters a0, a1, ... and puts all that comes of it into
// outputs r0, r1, ...
class CallWriter {
  public:
    CallWriter(const Builtin& row, const Signature& signature, bool wild, bool pairs)
        : row_(row),
          signature_(signature),
          random_{uint64_t(99 + 2 * signature.overload + int(wild))},
          wild_(wild) {
        std::vector<Signature::Argument> arguments = signature.arguments;
        if (signature.repeats) arguments.insert(arguments.end(), 2, signature.repeated);
        for (const Signature::Argument& argument : arguments) add_argument(argument);
        if (pairs) add_pairs();
        std::string call = std::string(row.name) + "(" + call_ + ")";
        BaseType result = signature.result.base;
        if (result == BaseType::Void)
            body_ += call + ";\n";
        else
            observe(result, call);
        body_ += after_;
    }

    // In the second form only some points reach the call.
    std::string source() const {
        std::string body = wild_ ? "if (v > 0.3) {\n" + body_ + "}\n" : body_;
        return "surface t(" + parameters_ + ") {\n" + locals_ + body + "Ci = Cs; Oi = Os;\n}\n";
    }

    std::vector<ParamBinding> params;
    Columns columns;
    std::vector<std::string> outputs;

  private:
    void add_argument(const Signature::Argument& argument) {
        BaseType type = argument.type.base;
        if (type == BaseType::Invalid) {  // printf and format: once, one of each
            if (anything_) return;
            anything_ = true;
            for (BaseType one : {BaseType::Float, BaseType::Color, BaseType::Point,
                                 BaseType::Vector, BaseType::Normal, BaseType::Matrix})
                add_argument({{one, -1}, false});
            return pass("\"text\"");
        }
        bool array = argument.type.is_array();
        if (argument.output) return array ? pass_array(type) : pass_variable(type);
        if (type == BaseType::String) return array ? pass(string_array()) : pass(literal());
        pass(parameter(type, array));
    }

    void pass(const std::string& text) {
        call_ += (call_.empty() ? "" : ", ") + text;
        ++position_;
    }

    std::string literal() const {
        BaseType written = BaseType::Invalid;
        for (const Signature::Argument& a : signature_.arguments)
            if (a.output) written = a.type.base;
        for (const Text& text : texts())
            if (text.row == row_.name &&
                (text.written == written || text.written == BaseType::Invalid))
                return std::string("\"") + text.texts[std::min(position_, text.texts.size() - 1)] +
                       "\"";
        return "\"world\"";
    }

    std::string string_array() {
        std::string name = "a" + std::to_string(position_);
        parameters_ += "string " + name + "[6] = {\"a\", \"b\"}; ";
        return name;
    }

    void pass_variable(BaseType type) {
        std::string local = "o" + std::to_string(position_);
        std::string start = type == BaseType::String ? "\"start\"" : parameter(type, false);
        locals_ += std::string(type_name(type)) + " " + local + " = " + start + ";\n";
        observe(type, local, true);
        pass(local);
    }

    void pass_array(BaseType type) {
        std::string local = "o" + std::to_string(position_);
        locals_ += std::string(type_name(type)) + " " + local + "[6];\n";
        if (type != BaseType::String) locals_ += local + "[2] = " + parameter(type, false) + ";\n";
        for (const char* element : {"[0]", "[2]", "[5]"}) observe(type, local + element, true);
        pass(local);
    }

    void add_pairs() {
        std::string a = parameter(BaseType::Float, false), tint = parameter(BaseType::Color, false);
        std::string_view row = row_.name;
        for (auto& [name, value] : kOptions) {
            if (!takes_option(row, name)) continue;
            pass(std::string("\"") + name + "\"");
            pass(std::string_view(value) == "a" ? a : value);
        }
        if (row == "bake3d") pass("\"value\""), pass(a), pass("\"tint\""), pass(tint);
        if (row == "texture3d") {
            pass("\"value\""), pass_variable(BaseType::Float);
            pass("\"tint\""), pass_variable(BaseType::Color);
        }
    }

    // A new parameter with values at all points; an array's are uniform.
    std::string parameter(BaseType type, bool array) {
        std::string name = "a" + std::to_string(parameter_count_++);
        parameters_ += std::string(array ? "uniform " : "varying ") + type_name(type) + " " + name +
                       (array ? "[6] = {0}; " : " = 0; ");
        params.push_back(
            {name, array ? ParamBinding::Kind::Frame : ParamBinding::Kind::Varying, {}, {}});
        for (int e = 0; e < (array ? 6 : 1); ++e)
            for (int c = 0; c < component_count(type); ++c) {
                std::string element = array ? "[" + std::to_string(e) + "]" : "";
                std::vector<float>& column = columns["param:0:" + name + element + suffix(type, c)];
                for (size_t i = 0; i < (array ? 1 : kPoints); ++i)
                    column.push_back(wild_ ? random_.wild() : random_.argument(false));
            }
        return name;
    }

    static std::string suffix(BaseType type, int c) {
        if (type == BaseType::Matrix) return "." + std::to_string(c);
        if (type == BaseType::Color) return std::string(".") + "rgb"[c];
        return is_triple(type) ? std::string(".") + "xyz"[c] : "";
    }

    // Puts a value into an output of its own: a string by what a map of that name answers.
    void observe(BaseType type, const std::string& value, bool behind_call = false) {
        bool text = type == BaseType::String;
        std::string name = "r" + std::to_string(outputs.size());
        parameters_ += std::string("output varying ") + (text ? "color" : type_name(type)) + " " +
                       name + " = 0; ";
        outputs.push_back(name);
        std::string seen = text ? "color texture(" + value + ", 0.25, 0.5)" : value;
        (behind_call ? after_ : body_) += name + " = " + seen + ";\n";
    }

    const Builtin& row_;
    const Signature& signature_;
    Random random_;
    bool wild_, anything_ = false;
    size_t position_ = 0;  // of the next argument
    int parameter_count_ = 0;
    std::string parameters_, locals_, call_, body_, after_;
};

std::string row_difference(const Builtin& row, const Signature& signature, bool wild, bool pairs,
                           DifferenceCounts& counts) {
    CallWriter call(row, signature, wild, pairs);
    LowerOptions options;
    options.aovs = call.outputs;
    RunShader run(call.source(), options, call.params);
    if (!run.ok()) return run.findings() + "\n" + call.source();
    std::string callee = fmt::format(" {}#{}}}", row.name, signature.overload);
    if (print_types(*run.shaders.back()->ast).find(callee) == std::string::npos)
        return "another overload is called:\n" + call.source();
    uint64_t seed = counts.shaders++;
    run.inputs = wild ? edge_points(seed, kPoints) : random_point(seed, kPoints);
    run.inputs.merge(call.columns);
    add_edge_world(run, seed, kPoints);
    std::string wrong = target_difference(run, kPoints, counts);
    if (wrong.empty() && (row.effects & kPrints) != 0 && run.told == 0) wrong = "nothing is told";
    return wrong.empty() ? "" : wrong + "\n" + call.source();
}

TEST(Rows, GiveTheSameBitsOnEveryTargetForAnyFloats) {
    DifferenceCounts counts;
    size_t rows = 0, overloads = 0;
    for (std::span<const Builtin> group : builtin_groups())
        for (const Builtin& row : group) {
            ++rows;
            ASSERT_TRUE(row.lower) << row.name;
            // Of arrays that are declared without a length: objects/objects_test.cpp.
            if (row.effects & kSetsLength) continue;
            for (const Signature& signature : parse_signatures(row.signature)) {
                ++overloads;
                for (bool wild : {false, true})
                    for (int pairs = 0; pairs <= int(signature.pairs); ++pairs)
                        EXPECT_EQ(row_difference(row, signature, wild, pairs != 0, counts), "")
                            << row.name << " overload " << signature.overload;
            }
        }
    std::printf("%zu rows, %zu overloads, %zu shaders, %zu values the same on each target\n", rows,
                overloads, counts.shaders, counts.bits);
    std::printf("digest of rows: %016llx\n", static_cast<unsigned long long>(counts.digest));
    EXPECT_GE(rows, 99u);
    EXPECT_GE(counts.shaders, 2 * overloads);
}

}  // namespace
}  // namespace kinora::rsl
