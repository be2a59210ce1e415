// runtime/player/pixel/explain_point.cpp: the reference's run of a point, and its result against
// the kernel's.
#include "runtime/player/pixel/explain_point.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "jit/ir/kernel_call.h"
#include "rsl/model/kernel_keys.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/kernel_runner.h"
#include "runtime/player/pixel/point_inputs.h"
#include "runtime/scene/build/instances/compile_instance.h"

namespace kinora {

namespace {

constexpr size_t kMostSteps = 5000;
constexpr int64_t kMostStatements = 2'000'000;
constexpr int kLoopBudget = 100'000;
// As tests/rsl/shader_difference.h judges: shares of 1 + |value|, and times what rounding moves.
constexpr double kFloor = 2e-5, kFastFloor = 5e-4, kFactor = 16, kUnstable = 0.25;
constexpr int kNearRuns = 4;

StoryVariable told(const rsl::ReferenceVariable& from) {
    StoryVariable out;
    out.name = std::string(from.name);
    out.type = rsl::type_name(from.type);
    out.varying = from.varying;
    out.text = from.type.base == rsl::BaseType::String;
    for (double x : from.values) {
        if (out.text)
            out.texts.push_back(rsl::interned(int32_t(x)));
        else
            out.values.push_back(float(x));
        out.nan = out.nan || (!out.text && std::isnan(x));
    }
    return out;
}

std::string_view trimmed(std::string_view line) {
    size_t begin = line.find_first_not_of(" \t\r"), end = line.find_last_not_of(" \t\r");
    return begin == std::string_view::npos ? "" : line.substr(begin, end + 1 - begin);
}

bool is_known(const Location& where, const SourceFiles& files) {
    return where.file != kNoFile && where.file < files.count();
}

StoryStep told(const rsl::ReferenceStep& from, const SourceFiles& files,
               const std::vector<std::string>& lights) {
    StoryStep out;
    out.inside = from.function ? fmt::format("function {}", from.function->name)
                               : fmt::format("{} {}", rsl::shader_kind_name(from.shader->kind),
                                             from.shader->name);
    if (is_known(from.where, files)) {
        out.file = files.name(from.where.file);
        out.line = files.line_column(from.where.file, from.where.begin).line;
        out.source = std::string(trimmed(files.line_text(from.where.file, out.line)));
    }
    out.turns.assign(from.turns.begin(), from.turns.end());
    if (from.light) out.light = lights.at(size_t(from.light->number));
    for (const rsl::ReferenceVariable& variable : from.changes)
        out.changes.push_back(told(variable));
    return out;
}

// The kernel's Ci or Oi; what it has no output for is `otherwise`.
std::array<float, 3> color_of(const jit::KernelCall& launch, rsl::Global id, float otherwise) {
    float* rows[3];
    find_color(launch.kernel, launch.out, id, rows);
    std::array<float, 3> color{};
    for (size_t k = 0; k < 3; ++k) color[k] = rows[k] ? rows[k][0] : otherwise;
    return color;
}

class Explanation {
  public:
    Explanation(RecordedPoint& point, const SourceFiles& files)
        : point_(point),
          files_(files),
          frame_(point.host.grid().frame),
          look_(*point.host.grid().look),
          layers_(bound_layers(look_, *frame_.resources.description)),
          light_names_(record_names(point.host)),
          spaces_(space_names(*frame_.resources.description)),
          inputs_(point_inputs(point.host, layers_)) {
        const Grid& grid = point.host.grid();
        if (look_.lowered.uses_lights)
            inputs_.lights = point_lights(point.host, grid.record_sets[0]);
        inputs_.service = [&point](rsl::Service service, std::span<const double> arguments) {
            return point.calls.answer(service, arguments);
        };
        if (!point.lights_at.empty()) inputs_.lights_at = &lights_at_;
        inputs_.lights_of = &lights_of_;
        inputs_.spaces = &spaces_;
        inputs_.loop_budget = kLoopBudget;
        inputs_.statement_budget = kMostStatements;
    }

    PointStory tell() {
        uint32_t row = point_.host.grid().hits.instance[point_.host.grid().points[0]];
        uint32_t material = frame_.shapes.surfaces[row].material;
        if (material != kNone)
            story_.material = frame_.resources.description->materials[material].id;
        story_.shader = look_.shader().name;
        story_.target = point_.launch.kernel.target;
        story_.code = machine_runs(point_.launch.kernel, files_, story_.no_code);
        story_.Ci = color_of(point_.launch, rsl::Global::Ci, 0);
        story_.Oi = color_of(point_.launch, rsl::Global::Oi, 1);
        rsl::ReferenceInputs watched = inputs_;
        rsl::ReferenceObserver observer = [this](const rsl::ReferenceStep& step) {
            if (story_.steps.size() < kMostSteps)
                story_.steps.push_back(told(step, files_, light_names_));
            else
                story_.cut = true;
        };
        watched.observer = &observer;
        rsl::ReferenceResult single = run<float>(watched);
        for (size_t k = 0; k < 3; ++k) story_.reference_Ci[k] = float(number(single, k));
        if (is_known(single.nan, files_)) {
            LineColumn at = files_.line_column(single.nan.file, single.nan.begin);
            story_.nan_file = files_.name(single.nan.file);
            story_.nan_line = at.line, story_.nan_column = at.column;
        }
        judge(single);
        return std::move(story_);
    }

  private:
    template <class Real>
    rsl::ReferenceResult run(const rsl::ReferenceInputs& inputs) {
        point_.calls.begin_run();
        return rsl::run_reference<Real>(layers_, inputs);
    }

    static double number(const rsl::ReferenceResult& result, size_t k) {
        auto found = result.values.find(rsl::text(rsl::global_key(rsl::Global::Ci, int(k))));
        return found == result.values.end() ? 0 : found->second;
    }

    // The lights of the question that was nearest to the position; at P where that is nearest.
    std::span<const rsl::ReferenceLight> lights_near(std::array<double, 3> at) const {
        auto apart = [&](std::array<double, 3> P) {
            return std::hypot(P[0] - at[0], P[1] - at[1], P[2] - at[2]);
        };
        auto own = [&](const char* name) { return inputs_.values.at(name); };
        double least = apart({own("P.x"), own("P.y"), own("P.z")});
        std::span<const rsl::ReferenceLight> best = inputs_.lights;
        for (const auto& asked : point_.lights_at)
            if (double d = apart(asked.position); d < least) least = d, best = asked.lights;
        return best;
    }

    void fail(Agreement agreement, std::string why) {
        story_.agreement = agreement;
        story_.why = std::move(why);
    }

    void judge(const rsl::ReferenceResult& single) {
        if (!single.missing.empty())
            return fail(Agreement::Unexplained,
                        fmt::format("the reference has no meaning for {}()", single.missing));
        if (single.too_long)
            return fail(Agreement::Unexplained, "the shader runs too many statements");
        rsl::ReferenceResult exact = run<double>(inputs_);
        const auto& unanswered = point_.calls.unanswered();
        if (!unanswered.empty())
            return fail(Agreement::Unexplained, fmt::format("the kernel made no such call of: {}",
                                                            fmt::join(unanswered, ", ")));
        bool fast = frame_.quality.math == jit::math::Tier::Fast;
        std::array<double, 3> moved{};
        bool decided = exact.decisions == single.decisions;
        if (!within(exact, single, moved, fast)) decided = shake(exact, single, moved) && decided;
        bool agrees = within(exact, single, moved, fast);
        if (agrees)
            fail(Agreement::Agrees, "");
        else if (!decided)
            fail(Agreement::Undecided, "rounding turns a branch at this point");
        else if (kFactor * *std::max_element(moved.begin(), moved.end()) > kUnstable)
            fail(Agreement::Undecided, "rounding alone moves the color by as much");
        else
            fail(Agreement::Differs, "the kernel's color is another than the reference's");
    }

    // Sets what may lie between the two, too.
    bool within(const rsl::ReferenceResult& exact, const rsl::ReferenceResult& single,
                const std::array<double, 3>& moved, bool fast) {
        bool all = true;
        for (size_t k = 0; k < 3; ++k) {
            double wanted = number(exact, k), got = double(story_.Ci[k]);
            double allowed =
                (fast ? kFastFloor : kFloor) * (1 + std::fabs(wanted)) + kFactor * moved[k];
            story_.allowed[k] = float(allowed);
            bool same_kind = !std::isfinite(got) && !std::isfinite(number(single, k));
            all = all && (same_kind || std::fabs(got - wanted) <= allowed);
        }
        return all;
    }

    // How far rounding moves the color; false where it turns a branch.
    bool shake(const rsl::ReferenceResult& exact, const rsl::ReferenceResult& single,
               std::array<double, 3>& moved) {
        bool decided = true;
        auto note = [&](const rsl::ReferenceResult& other) {
            decided = decided && other.decisions == exact.decisions;
            for (size_t k = 0; k < 3; ++k) {
                double d = std::fabs(number(other, k) - number(exact, k));
                if (d > moved[k]) moved[k] = d;
            }
        };
        note(single);
        for (int k = 0; k < kNearRuns; ++k) {
            rsl::ReferenceInputs near = inputs_;
            near.jitter = 1000 * uint64_t(k + 1);
            note(run<double>(near));
            note(run<float>(near));
        }
        return decided;
    }

    RecordedPoint& point_;
    const SourceFiles& files_;
    const ShadingFrame& frame_;
    const ShaderInstance& look_;
    std::vector<rsl::Layer> layers_;
    std::vector<std::string> light_names_, spaces_;
    rsl::ReferenceInputs inputs_;
    const rsl::ReferenceLightsAt lights_at_ = [this](std::array<double, 3> P) {
        return lights_near(P);
    };
    const rsl::ReferenceLightsOf lights_of_ =
        [this](double set) -> std::span<const rsl::ReferenceLight> {
        if (!(set >= 0 && set < double(point_.sampled.size()))) return {};
        return point_.sampled[size_t(set)];
    };
    PointStory story_;
};

}  // namespace

PointStory explain_point(RecordedPoint& point, const SourceFiles& files) {
    return Explanation(point, files).tell();
}

}  // namespace kinora
