// tests/rsl/builtin_forms_test.cpp: every overload and customary spelling of the built-ins
// compiles, and gives the same bits on every target. The calls are in files/forms/builtins.txt.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "jit/target.h"
#include "tests/folders.h"
#include "tests/rsl/edge_world.h"
#include "tests/rsl/shading_world.h"

namespace kinora::rsl {
namespace {

constexpr int kPoints = 19;  // more than one group, with a rest

struct Form {
    int line = 0;
    std::string kind;  // keyword of the shader
    std::string text;
};

const char* keyword(const std::string& letters) {
    if (letters == "di") return "displacement";
    if (letters == "li") return "light";
    if (letters == "vo") return "volume";
    return "surface";
}

std::vector<Form> forms() {
    std::vector<Form> result;
    std::ifstream file(project_folder() + "/tests/rsl/files/forms/builtins.txt");
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (line.empty() || line[0] == '#') continue;
        size_t bar = line.find(" | ");
        std::istringstream kinds(bar == std::string::npos || bar > 12 ? "su" : line.substr(0, bar));
        std::string text = bar == std::string::npos || bar > 12 ? line : line.substr(bar + 3);
        for (std::string kind; kinds >> kind;) result.push_back({number, keyword(kind), text});
    }
    return result;
}

// The variables that the forms use, from the point, and what became of them as outputs.
struct Variable {
    const char* type;
    const char* name;
    const char* initial;
};
constexpr Variable kVariables[] = {
    {"float", "a", "s * 3 - 1"},
    {"float", "b", "t"},
    {"float", "c", "s + t * 2"},
    {"color", "C", "color(s, t, 0.5)"},
    {"color", "D", "color(0.5, s, t)"},
    {"point", "P3", "point(s * 7, t * 5, s - t)"},
    {"point", "Q3", "point(t, s * 3, 1)"},
    {"vector", "V", "vector(s, 1, t - 0.5)"},
    {"vector", "W", "vector(1, t, s)"},
    {"normal", "N1", "normal(s, 1, t)"},
    {"normal", "N2", "normal(0, t, 1)"},
    {"matrix", "M", "matrix(1, s, 0, 0, t, 2, 0, 0, 0, s, 3, 0, s, t, 1, 1)"},
    {"matrix", "M2", "matrix(2, 0, t, 0, 0, 1, s, 0, s, 0, 1, 0, 0, 0, t, 1)"},
};

std::string source_of(const Form& form, std::vector<std::string>& outputs) {
    std::string outs, locals, after;
    for (const Variable& v : kVariables) {
        std::string out = std::string("out_") + v.name;
        outs += std::string("output varying ") + v.type + " " + out + " = 0; ";
        locals += std::string(v.type) + " " + v.name + " = " + v.initial + "; ";
        after += out + " = " + v.name + "; ";
        outputs.push_back(out);
    }
    const char* arrays =
        "float A[5]; color CA[5]; point PA[5]; vector VA[5]; normal NA[5]; matrix MA[2]; "
        "string SA[3] = {\"x\", \"y.tex\", \"world\"}; float k_; "
        "for (k_ = 0; k_ < 5; k_ += 1) { A[k_] = k_ * 0.25; CA[k_] = C * k_; PA[k_] = P3 * k_; "
        "VA[k_] = V + k_; NA[k_] = N1 - k_; } MA[0] = M; "
        "string VS = \"world\"; if (s > 0.5) VS = \"object\"; ";
    return form.kind + std::string(" form(string S = \"world\"; string SBASIS = \"bspline\"; ") +
           "string CSPACE = \"hsv\"; float roughness = 0.1; " + outs + ") { " + locals + arrays +
           "\n" + form.text + "\n" + after + "}";
}

// Services answer with something that differs between lanes and results.
template <size_t results>
void answer(const jit::ServiceCall& call) {
    for (size_t k = 0; k < results; ++k)
        for (size_t i = 0; i < jit::kMaxLanes; ++i)
            call.results[k * jit::kMaxLanes + i] =
                0.25f * float(k % 4) + 0.01f * float(call.first + int(i));
}
template <size_t... k>
jit::ServiceFn answer_of(size_t results, std::index_sequence<k...>) {
    constexpr jit::ServiceFn kAnswers[] = {answer<k>...};
    return kAnswers[results];
}

std::map<std::string, std::vector<float>> run_on(const char* target, const Form& form, bool edges) {
    std::vector<std::string> outputs;
    LowerOptions options;
    std::string source = source_of(form, outputs);
    options.aovs = outputs;
    RunShader run(source, options, {}, false, target);
    EXPECT_TRUE(run.ok()) << "builtins.txt:" << form.line << " in a " << form.kind << ": "
                          << form.text << "\n"
                          << run.findings();
    if (!run.ok()) return {};
    if (edges) {
        run.inputs = edge_points(uint64_t(form.line), kPoints);
        add_edge_world(run, uint64_t(form.line), kPoints);
        return run.run(kPoints);
    }
    for (const jit::Kernel* kernel : {run.kernels.point.get(), run.kernels.frame.get()})
        for (size_t k = 0; kernel && k < kernel->services.size(); ++k)
            if (Service service = find_service(kernel->services[k].name).value();
                !string_service(service))
                run.services[service] =
                    answer_of(size_t(result_count(service)), std::make_index_sequence<64>());
    for (int i = 0; i < kPoints; ++i) {
        float x = float(i) / kPoints;
        run.inputs["s"].push_back(x);
        run.inputs["t"].push_back(1 - x * x);
        run.inputs["u"].push_back(x), run.inputs["v"].push_back(1 - x);
        run.inputs["P.x"].push_back(x * 2), run.inputs["P.y"].push_back(1 - x);
    }
    run.set3("N", 0, 0.6f, 0.8f), run.set3("Ng", 0, 0, 1), run.set3("I", 0.1f, 0.2f, -1);
    run.set3("dPdu", 1, 0, 0.2f), run.set3("dPdv", 0, 1, 0);
    run.set("du", 0.1f), run.set("dv", 0.2f), run.set("dsdu", 1), run.set("dtdv", 1);
    return run.run(kPoints);
}

// The calls' arguments follow from s and t: these at mild points and at edges.
void compare(const Form& form, bool edges, int& compared) {
    auto expected = run_on("interp", form, edges);
    for (const jit::Target& target : jit::targets()) {
        if (std::string_view(target.name) == "interp" || !target.supported()) continue;
        auto got = run_on(target.name, form, edges);
        for (auto& [name, values] : expected)
            for (size_t i = 0; i < values.size(); ++i, ++compared)
                EXPECT_TRUE(same_bits(values[i], got[name][i]))
                    << "builtins.txt:" << form.line << " " << name << " on " << target.name << ": "
                    << got[name][i] << ", interp " << values[i] << (edges ? " at edges" : "");
    }
}

TEST(BuiltinForms, CompileAndGiveTheSameBitsOnEveryTarget) {
    int compared = 0;
    for (const Form& form : forms())
        for (bool edges : {false, true}) compare(form, edges, compared);
    EXPECT_GT(compared, 2000);
}

}  // namespace
}  // namespace kinora::rsl
