// tests/rsl/constructs_test.cpp: one small shader for each construct that real shaders use. Those
// below constructs/ compile, those of constructs/rejected give one error; constructs/README.md says
// so. rsl_differential_test compares the code of constructs/ with the reference and on every
// target.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "tests/folders.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(project_folder()) / "tests/rsl/constructs";

// Constructs of real shaders, and the file that has each.
constexpr struct {
    const char* construct;
    const char* file;
} kRows[] = {
    {"#include, <x.h> and \"x.h\", no last newline", "preprocessor/preprocessor_include"},
    {"function-like macros", "preprocessor/preprocessor_macros"},
    {"#if defined(), #ifdef chains", "preprocessor/preprocessor_conditions"},
    {"// comments", "preprocessor/comments"},
    {"user functions", "functions/function_typed"},
    {"more than one return", "functions/function_several_returns"},
    {"nested functions", "functions/function_nested"},
    {"extern", "functions/function_extern_globals"},
    {"recursion", "control/recursion"},
    {"if", "control/control_if"},
    {"if (s): float as condition", "control/control_float_condition"},
    {"for", "control/control_for"},
    {"for (i=0,j=1;..;i+=1,j+=1)", "control/control_for"},
    {"while", "control/control_while"},
    {"if \"any\" (..), while \"all\" (..)", "control/control_any_all"},
    {"break, continue, varying", "control/control_break"},
    {"break 2", "control/control_break_levels"},
    {"ternary", "control/control_ternary"},
    {"string type", "expressions/expression_strings"},
    {"string compare", "expressions/expression_strings"},
    {"string = format(\"%f\", s)", "expressions/expression_varying_string"},
    {"array indexing", "expressions/arrays_local"},
    {"fixed array declarations, = {..}", "expressions/arrays_local"},
    {"array parameters", "parameters/parameters_arrays"},
    {"T x[] parameters of functions", "functions/function_arrays"},
    {"T x[] of shaders", "parameters/parameters_arrays"},
    {"T a[] (resizable)", "arrays/resizable_basics"},
    {"T a[] of per-point length", "arrays/resizable_per_point"},
    {"T a[] as an argument", "arrays/resizable_arguments"},
    {"T a[] of more than 64 elements", "arrays/resizable_long"},
    {"whole-array assign a = b", "expressions/arrays_assigned"},
    {"matrix", "expressions/expression_matrix"},
    {"matrix \"space\" 1, m == m", "expressions/expression_matrix"},
    {"uniform", "parameters/parameters_details"},
    {"uniform x = varying expression", "rejected/error_uniform_from_varying"},
    {"output AOV", "kinds/aov_outputs"},
    {"parameter default expressions, space defaults", "parameters/parameters_spaces"},
    {"bool as float", "expressions/expression_bool"},
    {"Ci[0] read and written", "expressions/expression_components"},
    {"implicit mix of point vector normal color", "expressions/expression_triples"},
    {"pow mod abs smoothstep of colors", "expressions/expression_componentwise"},
    {"float = vector", "rejected/error_float_from_vector"},
    {"identifiers named light, volume", "names/names_contextual"},
    {"illuminance", "lights/illuminance_cone"},
    {"illuminate", "lights/light_point"},
    {"solar", "lights/light_solar"},
    {"gather", "builtins/tracing_gather"},
    {"class", "classes/class_members"},
    {"class light() volume() displacement()", "classes/class_light"},
    {"struct", "structs/struct_members"},
    {"shader handles", "classes/shader_handles"},
    {"->", "structs/struct_methods"},
    {"writeaov readaov stof strlen sprintf constant", "builtins/named_outputs"},
    {"readprimvar, getvar(null, ..) of any name", "builtins/primitive_variables"},
    {"writeaov(format(..), x)", "builtins/named_outputs_run_time"},
    {"default arguments", "functions/function_defaults"},
    {"noise", "builtins/noise_forms"},
    {"cellnoise", "builtins/noise_cell"},
    {"pnoise", "builtins/noise_periodic"},
    {"texture, channel [n], 8 coordinates, \"blur\"", "builtins/texture_forms"},
    {"environment, shadow", "builtins/texture_environment"},
    {"textureinfo, rendererinfo", "builtins/texture_info"},
    {"rayinfo, trace, transmission", "builtins/tracing"},
    {"occlusion, indirectdiffuse", "builtins/tracing_indirect"},
    {"spline, spline(basis, ..)", "builtins/spline_forms"},
    {"spline over T a[]", "builtins/spline_resizable"},
    {"calculatenormal, area, Du, Dv, filterstep", "builtins/derivatives"},
    {"ctransform", "builtins/spaces"},
    {"fresnel", "builtins/geometry_builtins"},
    {"lightsource()", "lights/illuminance_lightsource"},
    {"printf", "builtins/printing"},
    {"Ns", "globals/globals_ns"},
    {"dPdtime, dtime", "globals/globals_surface_read"},
    {"surface writes P, N, s, t, Cs", "globals/globals_surface_write"},
    {"surface writes u, v, I", "globals/globals_surface_write"},
    {"displacement writes Ci", "globals/globals_displacement"},
    {"transformation (deformation)", "kinds/transformation_bend"},
    {"surface() displacement() incident() opposite()", "builtins/messages"},
    {"unknown function", "rejected/error_unknown_function"},
    {"C-style commas between parameters", "parameters/parameters_c_commas"},
    {"trailing semicolons", "parameters/parameters_trailing"},
    {"(float) x", "expressions/expression_casts"},
    {"precedence of ^ * .", "expressions/expression_precedence"},
};

// A test shader compiled and, where its kind has code, lowered.
struct Construct {
    explicit Construct(const fs::path& path) : source(read_file(path), path.c_str()) {
        what = source.text.substr(0, source.text.find_first_of("\r\n"));
        what.erase(0, what.find_first_not_of("/ "));
        auto shaders = compile(source.source, {}, source.diagnostics);
        for (const auto& shader : shaders) {
            Layer layer{shader.get(), {}};
            if (shader->kind < ShaderKind::Imager) lower({&layer, 1}, {}, source.diagnostics);
        }
        for (const Finding& f : source.diagnostics.findings())
            if (f.severity >= Severity::Error) errors.push_back(f.info->code);
    }
    std::string result() const {
        if (errors.empty()) return "compiles";
        return fmt::format("error {}", errors[0]);
    }
    TestSource source;
    std::string what;
    std::vector<std::string> errors;
};

// Results by path below kFolder without .sl, as kRows has it.
const std::map<std::string, Construct>& constructs() {
    static std::map<std::string, Construct> all;
    if (!all.empty()) return all;
    for (const fs::path& path : shader_files("tests/rsl/constructs"))
        all.try_emplace(fs::relative(path, kFolder).replace_extension().string(), path);
    return all;
}

TEST(Constructs, ThatShadersUseCompileAndThoseOfRsl2GiveOneError) {
    int files = 0;
    for (const auto& [name, construct] : constructs()) {
        bool rejected = name.starts_with("rejected/");
        EXPECT_EQ(construct.errors.size(), rejected ? 1u : 0u) << name << "\n"
                                                               << construct.source.messages();
        ++files;
    }
    EXPECT_GE(files, 131);
}

std::string readme() {
    std::string text =
        "# Constructs\n\nWritten by rsl_front_test (Constructs.TheReadmeIsTrue) with "
        "KINORA_UPDATE=1; do not edit.\nThe code of what compiles is compared with the reference "
        "and between targets by rsl_differential_test.\n\n"
        "## Constructs of real shaders\n\n"
        "| construct | test | result |\n|---|---|---|\n";
    for (const auto& row : kRows)
        text += fmt::format("| `{}` | [{}]({}.sl) | {} |\n", row.construct, row.file, row.file,
                            constructs().at(row.file).result());
    text += "\n## All files\n\n| test | what it has | result |\n|---|---|---|\n";
    for (const auto& [name, construct] : constructs())
        text += fmt::format("| [{}]({}.sl) | {} | {} |\n", name, name, construct.what,
                            construct.result());
    return text;
}

TEST(Constructs, TheReadmeIsTrue) {
    for (const auto& row : kRows) ASSERT_TRUE(constructs().contains(row.file)) << row.file;
    if (std::getenv("KINORA_UPDATE")) std::ofstream(kFolder / "README.md") << readme();
    EXPECT_EQ(read_file(kFolder / "README.md"), readme()) << "run with KINORA_UPDATE=1";
}

// An array literal of 64 Ki elements: a compiler that copies its list at each comma takes minutes.
TEST(Constructs, ALargeArrayLiteralCompiles) {
    std::string text = "surface x(float table[65536] = {";
    for (int i = 0; i < 65536; ++i) text += (i ? "," : "") + std::to_string(i % 100) + ".5";
    TestSource source(text + "}) { Ci = table[s * 65535]; }");
    auto shaders = compile(source.source, {}, source.diagnostics);
    ASSERT_EQ(shaders.size(), 1u) << source.messages();
    ASSERT_TRUE(shaders[0]->parameters[0].constant);
    EXPECT_EQ(shaders[0]->parameters[0].constant->numbers.size(), 65536u);
    EXPECT_EQ(shaders[0]->parameters[0].constant->numbers[65535], 35.5f);
}

}  // namespace
}  // namespace kinora::rsl
