// runtime/programs/shade/tradeoff.cpp: what each target, math tier and use of derivatives of a
// shader costs, and how far its outputs are from the reference evaluator in double precision.
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/base/cpu_clock.h"
#include "runtime/picture/compare/ulp.h"
#include "runtime/picture/trade/front.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/compare.h"

namespace kinora {

namespace {

constexpr int kTimes = 11;  // of each setting, one after the other, so that ratios hold

struct Setting {
    const jit::Target* target;
    jit::math::Tier math;
    bool derivatives;
};

struct Measured {
    Setting setting;
    std::unique_ptr<ShadeKernel> kernel;
    ShadeStack stack;  // the kernel points into it
    std::vector<double> ms, ratios;
    std::map<std::string, FloatErrors> errors;  // by output
    size_t points_changed = 0;                  // with a value other than that of the first setting

    double mpoints(size_t points) const {
        return double(points) * 1e-3 / median_interval(ms).median;
    }
};

const char* math_name(const Setting& setting) {
    return setting.math == jit::math::Tier::Fast ? "fast" : "precise";
}

// The best target first; interp is the slowest and the last.
std::vector<Setting> settings_of(const ShadeOptions& options) {
    std::vector<const jit::Target*> targets;
    for (const jit::Target& target : jit::targets())
        if (target.supported() && (!options.target || options.target == &target))
            targets.push_back(&target);
    std::ranges::stable_sort(targets, std::greater<>(), &jit::Target::lanes);
    std::vector<Setting> settings;
    for (const jit::Target* target : targets)
        for (jit::math::Tier math : {jit::math::Tier::Precise, jit::math::Tier::Fast})
            for (bool derivatives : {true, false}) settings.push_back({target, math, derivatives});
    return settings;
}

// Whether any of its values rests on derivatives: else a row without them says nothing new.
bool uses_derivatives(const ShadeKernel& with, const ShadeKernel& without) {
    return with.pair().point->code_bytes != without.pair().point->code_bytes ||
           with.pair().point->inputs.size() != without.pair().point->inputs.size();
}

bool compile_setting(const Setting& setting, const ShadeStack& stack, const Patch& patch,
                     Diagnostics& diagnostics, Measured& row) {
    row.setting = setting;
    row.stack = stack;
    row.stack.lower.math = setting.math;
    row.stack.derivatives = setting.derivatives;
    row.kernel = std::make_unique<ShadeKernel>();
    if (!row.kernel->compile(row.stack, setting.target, diagnostics)) return false;
    row.kernel->bind(row.stack, patch);
    return true;
}

// Without those that have no derivatives to leave out.
std::vector<std::unique_ptr<Measured>> compile_settings(const ShadeOptions& options,
                                                        const ShadeStack& stack, const Patch& patch,
                                                        Diagnostics& diagnostics) {
    std::vector<std::unique_ptr<Measured>> rows;
    for (const Setting& setting : settings_of(options)) {
        auto row = std::make_unique<Measured>();
        const size_t known = diagnostics.findings().size();
        if (!compile_setting(setting, stack, patch, diagnostics, *row)) return {};
        if (!rows.empty()) diagnostics.drop_repeats(known);
        if (setting.derivatives || uses_derivatives(*rows.back()->kernel, *row->kernel))
            rows.push_back(std::move(row));
    }
    return rows;
}

void time_settings(std::vector<std::unique_ptr<Measured>>& rows, int times) {
    for (auto& row : rows) row->kernel->run();
    for (int i = 0; i < times; ++i) {
        for (auto& row : rows) {
            const double begin = thread_cpu_ms();
            row->kernel->run();
            row->ms.push_back(std::max(thread_cpu_ms() - begin, 1e-6));
        }
        for (auto& row : rows) row->ratios.push_back(row->ms.back() / rows[0]->ms.back());
    }
}

void compare_settings(std::vector<std::unique_ptr<Measured>>& rows, const ReferenceRun& exact) {
    const ShadeOutputs first = rows[0]->kernel->outputs();
    for (auto& row : rows) {
        const ShadeOutputs outputs = row->kernel->outputs();
        for (const ReferencePoint& point : exact.points) {
            bool changed = false;
            for (const auto& [name, values] : outputs) {
                const float got = values[point.index];
                if (auto found = point.values.find(name); found != point.values.end())
                    row->errors[name].add(got, found->second);
                changed |= got != first.at(name)[point.index];
            }
            row->points_changed += changed;
        }
    }
}

void print_rows(const std::vector<std::unique_ptr<Measured>>& rows, size_t points) {
    std::printf("%-8s %-8s %-11s %10s %7s %8s  %-8s %10s %10s %8s\n", "target", "math",
                "derivatives", "Mpoints/s", "time", "bytes", "output", "max ULP", "mean ULP",
                "special");
    for (const auto& row : rows) {
        const Setting& s = row->setting;
        std::printf("%-8s %-8s %-11s %10.2f %6.2fx %8zu", s.target->name, math_name(s),
                    s.derivatives ? "on" : "off", row->mpoints(points),
                    median_interval(row->ratios).median, row->kernel->pair().point->code_bytes);
        bool begun = false;
        for (const auto& [name, errors] : row->errors) {
            std::printf("%*s  %-8s %10.3g %10.3g %8zu\n", begun ? 58 : 0, "", name.c_str(),
                        errors.max(), errors.mean(), errors.special());
            begun = true;
        }
        if (!begun) std::printf("\n");
    }
}

void print_histograms(const std::vector<std::unique_ptr<Measured>>& rows) {
    std::printf("\nvalues with an error of at most so many ULP\n%-28s", "");
    for (double edge : FloatErrors::kEdges) std::printf(" %7g", edge);
    std::printf("    more\n");
    for (const auto& row : rows)
        for (const auto& [name, errors] : row->errors) {
            const Setting& s = row->setting;
            std::printf("%-8s%-8s%-4s%-8s", s.target->name, math_name(s),
                        s.derivatives ? "on" : "off", name.c_str());
            for (size_t n : errors.histogram()) std::printf(" %7zu", n);
            std::printf("\n");
        }
}

nlohmann::ordered_json json_of(const Measured& row, size_t points) {
    const MedianInterval ratio = median_interval(row.ratios);
    nlohmann::ordered_json json{{"target", row.setting.target->name},
                                {"math", math_name(row.setting)},
                                {"derivatives", row.setting.derivatives},
                                {"points_per_second", 1e6 * row.mpoints(points)},
                                {"time", ratio.median},
                                {"time_low", ratio.low},
                                {"time_high", ratio.high},
                                {"code_bytes", row.kernel->pair().point->code_bytes},
                                {"points_changed", row.points_changed}};
    json["outputs"] = nlohmann::ordered_json::array();
    for (const auto& [name, errors] : row.errors)
        json["outputs"].push_back({{"name", name},
                                   {"values", errors.count()},
                                   {"special", errors.special()},
                                   {"max_ulp", errors.max()},
                                   {"mean_ulp", errors.mean()},
                                   {"histogram", errors.histogram()}});
    return json;
}

}  // namespace

int shade_tradeoff(const ShadeOptions& options) {
    ShadeSource source;
    Patch patch(options.width, options.height, options.sphere);
    ShadeStack stack;
    if (std::optional<int> code = open_stack(options, source, patch, stack)) return *code;
    const rsl::Shader* shader = stack.layers.front().shader;
    auto rows = compile_settings(options, stack, patch, source.diagnostics);
    source.print_findings(options);
    if (rows.empty()) return kExitShader;
    time_settings(rows, options.iterations ? options.iterations : kTimes);
    const ReferenceRun exact = run_over_reference(stack, patch, *rows[0]->kernel);
    if (exact.missing.empty()) compare_settings(rows, exact);
    if (options.json) {
        nlohmann::ordered_json all{{"name", shader->name},
                                   {"kind", rsl::shader_kind_name(shader->kind)},
                                   {"points", patch.count()},
                                   {"compared", exact.points.size()},
                                   {"undecided", exact.undecided},
                                   {"without_reference", exact.missing},
                                   {"read_unfiltered", exact.unfiltered},
                                   {"histogram_edges", FloatErrors::kEdges}};
        all["rows"] = nlohmann::ordered_json::array();
        for (const auto& row : rows) all["rows"].push_back(json_of(*row, patch.count()));
        std::printf("%s\n", all.dump(2).c_str());
        return source.exit_code(options, kExitOk);
    }
    std::printf(
        "%s %s: %zu points on one thread; the reference: %zu points compared, %zu branch "
        "or floor differently and are left out\n",
        rsl::shader_kind_name(shader->kind), shader->name.c_str(), patch.count(),
        exact.points.size(), exact.undecided);
    if (!exact.missing.empty())
        std::printf("reference: has no meaning for '%s' yet: no errors\n", exact.missing.c_str());
    for (const std::string& service : exact.unfiltered)
        std::printf("reference: reads %s unfiltered, so large pixels differ\n", service.c_str());
    print_rows(rows, patch.count());
    if (exact.missing.empty()) print_histograms(rows);
    return source.exit_code(options, kExitOk);
}

}  // namespace kinora
