// tests/rsl/differential_rows_test.cpp: pure built-in rows over edge and random values: lowered
// code against the reference. Bits on the targets: row_edges_test.cpp.
#include <gtest/gtest.h>

#include "rsl/builtins/table.h"
#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

const char* sample_text(std::string_view function) {
    if (function == "ctransform") return "hsv";
    if (function == "spline") return "bspline";
    return "world";
}

// Rows that add terms of unlike size: any formula loses the small ones beside huge ones.
bool moderate(std::string_view name) {
    static const std::set<std::string_view> kRows = {"spline",  "ptlined", "rotate",
                                                     "refract", "fresnel", "specularbrdf"};
    return kRows.count(name) > 0;
}

// A surface that calls one overload with parameters a0, a1, ... and puts what comes out into r0,
// ...
struct RowShader {
    std::string source;
    std::vector<ParamBinding> params;
    Columns columns;
    std::vector<std::string> outputs;  // with component suffixes
    std::vector<std::string> aovs;
};

class RowWriter {
  public:
    RowWriter(const Builtin& row, const Signature& signature, uint64_t seed)
        : row_(row), signature_(signature), random_{seed} {}

    RowShader write() {
        std::vector<Signature::Argument> arguments = signature_.arguments;
        if (signature_.repeats) arguments.insert(arguments.end(), 2, signature_.repeated);
        for (size_t k = 0; k < arguments.size(); ++k) argument(k, arguments[k]);
        std::string_view row_name = row_.name;
        if (row_name == "refract" || row_name == "fresnel")
            for (const char* name : {"param:0:a0", "param:0:a1"}) make_unit(name);
        for (const char* ratio : {"param:0:a2", "param:0:a3"})  // eta, roughness: positive
            if (auto found = shader_.columns.find(ratio);
                found != shader_.columns.end() &&
                (row_name == "fresnel" || row_name == "specularbrdf"))
                for (float& x : found->second) x = 0.1f + std::fabs(x);
        std::string call = std::string(row_.name) + "(" + call_ + ")";
        if (signature_.result.base == BaseType::Void)
            body_ += call + "; ";
        else
            body_ += result(signature_.result.base) + " = " + call + "; ";
        shader_.source =
            "surface t(" + parameters_ + ") { " + body_ + after_ + "Ci = Cs; Oi = Os; }";
        return shader_;
    }

    static constexpr size_t kPoints = 160;

  private:
    void argument(size_t k, const Signature::Argument& argument) {
        if (!call_.empty()) call_ += ", ";
        BaseType type = argument.type.base;
        bool array = argument.type.is_array();
        if (type == BaseType::String && !array) {
            call_ += std::string("\"") + sample_text(row_.name) + "\"";
            return;
        }
        std::string name = "a" + std::to_string(k);
        if (type == BaseType::String) {
            parameters_ += "string " + name + "[6] = {\"a\"}; ";
            call_ += name;
            return;
        }
        parameters_ += std::string(array ? "uniform " : "varying ") + type_name(type) + " " + name +
                       (array ? "[6] = {0}" : " = 0") + "; ";
        shader_.params.push_back(
            {name, array ? ParamBinding::Kind::Frame : ParamBinding::Kind::Varying, {}, {}});
        for (int e = 0; e < (array ? 6 : 1); ++e)
            column("param:0:" + name + (array ? "[" + std::to_string(e) + "]" : ""), type, array);
        if (!argument.output) {
            call_ += name;
            return;
        }
        std::string local = "o" + std::to_string(k);
        body_ += std::string(type_name(type)) + " " + local + " = " + name + "; ";
        call_ += local;
        after_ += result(type) + " = " + local + "; ";
    }

    void column(const std::string& name, BaseType type, bool one) {
        for (int c = 0; c < component_count(type); ++c)
            for (size_t i = 0; i < (one ? 1 : kPoints); ++i)
                shader_.columns[name + suffix(type, c)].push_back(
                    random_.argument(moderate(row_.name)));
    }

    // Directions that the row expects to have length 1.
    void make_unit(const std::string& name) {
        auto& columns = shader_.columns;
        for (size_t i = 0; i < kPoints; ++i) {
            float* v[] = {&columns[name + ".x"][i], &columns[name + ".y"][i],
                          &columns[name + ".z"][i]};
            float length = std::sqrt(*v[0] * *v[0] + *v[1] * *v[1] + *v[2] * *v[2]);
            for (float* x : v) *x /= length;
        }
    }

    static std::string suffix(BaseType type, int c) {
        if (type == BaseType::Matrix) return "." + std::to_string(c);
        if (type == BaseType::Color) return std::string(".") + "rgb"[c];
        return is_triple(type) ? std::string(".") + "xyz"[c] : "";
    }

    // A new output parameter.
    std::string result(BaseType type) {
        std::string name = "r" + std::to_string(shader_.aovs.size());
        parameters_ += std::string("output varying ") + type_name(type) + " " + name + " = 0; ";
        shader_.aovs.push_back(name);
        for (int c = 0; c < component_count(type); ++c)
            shader_.outputs.push_back("aov:" + name + suffix(type, c));
        return name;
    }

    const Builtin& row_;
    const Signature& signature_;
    Random random_;
    RowShader shader_;
    std::string parameters_, body_, call_, after_;
};

struct RowReport {
    int compared = 0, undecided = 0;
    double worst = 0;  // share of what is allowed
    std::string example;
};

// Allowed: the row's ULP, and a few times what rounding the arguments alone changes.
void compare(double got, double single, double exact, double condition, const Builtin& row,
             RowReport& report, const std::string& what) {
    bool extreme = !std::isfinite(exact) || std::fabs(exact) > 1e37 || !std::isfinite(single);
    if (extreme || !std::isfinite(condition)) return;
    double terms = moderate(row.name) ? 2e-6 : 0;  // of size 2, which may cancel
    double allowed = std::max(1, row.tolerance_ulp) * ulp(exact) + condition + terms + 1e-36;
    double share = std::isfinite(got) ? std::fabs(got - exact) / allowed : 1e30;
    ++report.compared;
    if (share <= report.worst) return;
    report.worst = share;
    char text[200];
    std::snprintf(text, sizeof text, "%s: got %.9g, float %.9g, exactly %.17g", what.c_str(), got,
                  single, exact);
    report.example = text;
}

std::string point_text(const ReferenceInputs& inputs) {
    std::string text;
    for (auto& [name, value] : inputs.values) {
        if (name.rfind("param:0:a", 0) != 0) continue;
        char item[60];
        std::snprintf(item, sizeof item, "%s=%.9g ", name.c_str() + 8, value);
        text += item;
    }
    return text;
}

// How far arguments that differ by up to one ULP from these move the results: 6 times the largest
// change, and that of float arithmetic. Empty if they turn a decision.
std::map<std::string, double> conditions(const Layer& layer, const ReferenceInputs& inputs,
                                         const ReferenceResult& exact,
                                         const ReferenceResult& single) {
    std::map<std::string, double> largest;
    Random random{5};
    for (auto& [name, value] : exact.values)
        largest[name] = 6 * std::fabs(single.values.at(name) - value);
    for (int k = 0; k < 6; ++k) {
        ReferenceInputs moved = inputs;
        for (auto& [name, value] : moved.values)
            value *= 1 + double(random.uniform(-1, 1)) * 0x1p-23;
        ReferenceResult result = run_reference<double>({&layer, 1}, moved);
        if (result.decisions != exact.decisions) return {};
        for (auto& [name, value] : exact.values)
            largest[name] = std::max(largest[name], 6 * std::fabs(result.values.at(name) - value));
    }
    return largest;
}

RowReport run_row(const Builtin& row, const Signature& signature) {
    RowReport report;
    RowShader shader = RowWriter(row, signature, 99 + size_t(signature.overload)).write();
    LowerOptions options;
    options.aovs = shader.aovs;
    RunShader run(shader.source, options, shader.params);
    EXPECT_TRUE(run.ok()) << shader.source << "\n" << run.findings();
    if (!run.ok()) return report;
    run.inputs = shader.columns;
    run.set("camera:near", 0.5f), run.set("camera:far", 100);
    shader.columns["camera:near"] = {0.5f}, shader.columns["camera:far"] = {100};
    auto got = run.run(int(RowWriter::kPoints));
    Layer layer{run.shaders.back().get(), shader.params};
    for (size_t i = 0; i < RowWriter::kPoints; ++i) {
        ReferenceInputs inputs = at_point(shader.columns, {}, i);
        ReferenceResult exact = run_reference<double>({&layer, 1}, inputs);
        ReferenceResult single = run_reference<float>({&layer, 1}, inputs);
        auto condition = conditions(layer, inputs, exact, single);
        if (exact.decisions != single.decisions || condition.empty()) {
            ++report.undecided;
            continue;
        }
        for (const std::string& name : shader.outputs)
            compare(got.at(name)[i], single.values.at(name), exact.values.at(name),
                    condition.at(name), row, report, point_text(inputs));
    }
    return report;
}

TEST(Rows, LoweredCodeAgreesWithTheReference) {
    int rows = 0, points = 0, undecided = 0;
    for (std::span<const Builtin> group : builtin_groups()) {
        for (const Builtin& row : group) {
            bool pure = (row.effects & ~uint32_t(kDerivative)) == 0;
            if (!row.lower || !row.ref.single || !pure) continue;
            if (row.signature[0] == 's' || std::string_view(row.name) == "match") continue;
            for (const Signature& signature : parse_signatures(row.signature)) {
                RowReport report = run_row(row, signature);
                ++rows, points += report.compared, undecided += report.undecided;
                EXPECT_LE(report.worst, 1)
                    << row.name << " overload " << signature.overload << " " << report.example;
            }
        }
    }
    std::printf("%d overloads, %d values compared, %d points undecided\n", rows, points, undecided);
    EXPECT_GT(rows, 100);
}

}  // namespace
}  // namespace kinora::rsl
