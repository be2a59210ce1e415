// runtime/programs/shade/compare.cpp: differences to the interpreter and the reference.
#include "runtime/programs/shade/compare.h"
#include "runtime/programs/common/standard_streams.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <memory>

#include "jit/ir/kernel_call.h"
#include "rsl/reference/reference.h"
#include "runtime/scene/kernels/columns.h"
#include "runtime/scene/kernels/point_source.h"

namespace kinora {

namespace {

constexpr size_t kReferencePoints = 4096;

// The largest difference so far and where it is.
struct Worst {
    double difference = -1;
    std::string output;
    size_t point = 0;
    double got = 0, wanted = 0;

    void meet(double a, double b, const std::string& name, size_t i) {
        double d = std::isnan(a) && std::isnan(b) ? 0 : std::fabs(a - b);
        if (std::isnan(d)) d = a == b ? 0 : INFINITY;
        if (d <= difference) return;
        *this = {d, name, i, a, b};
    }
    void print(const Patch& patch) const {
        if (difference <= 0) return;
        const PatchPoint& p = patch[point];
        std::printf("largest difference %.3g: %s at u %.5g v %.5g is %.9g, not %.9g\n", difference,
                    output.c_str(), p.u, p.v, got, wanted);
    }
};

bool same_bits(float a, float b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

// A service as the reference asks for it: one lane, doubles.
rsl::ReferenceService reference_service(const Patch& patch, const ShadeKernel& kernel) {
    return [&](rsl::Service service, std::span<const double> arguments) -> std::vector<double> {
        if (service == rsl::Service::gather) return {0.0};  // no rays, as shade_services has it
        std::vector<jit::Type> params, results;
        bool called = false;
        for (const auto* k : {kernel.pair().point.get(), kernel.pair().frame.get()})
            for (size_t s = 0; k && s < k->services.size(); ++s)
                if (k->services[s].name == rsl::service_name(service)) {
                    called = true;
                    params = k->services[s].params;
                    results = k->services[s].results;
                }
        if (!called) return {};  // the code does without: what it answers changes nothing
        // Services read all that kernels hand them; the reference gives no derivatives.
        size_t rows = std::max(arguments.size(), params.size()) + 1;
        std::vector<float> in(rows * jit::kMaxLanes);
        std::vector<float> out((results.size() + 1) * jit::kMaxLanes);
        for (size_t a = 0; a < arguments.size(); ++a) {
            bool is_int = a < params.size() && params[a] == jit::Type::I;
            in[a * jit::kMaxLanes] =
                is_int ? jit::float_of(int32_t(arguments[a])) : float(arguments[a]);
        }
        PrintedLines printed;
        PatchHost host(patch, printed);
        find_service(rsl::service_name(service))(
            {static_cast<KernelHost*>(&host), in.data(), out.data(), 1, 0, 1});
        printed.show(print_to(stdout));
        std::vector<double> answer;
        for (size_t r = 0; r < results.size(); ++r) {
            float value = out[r * jit::kMaxLanes];
            answer.push_back(results[r] == jit::Type::I ? jit::bits_of(value) : double(value));
        }
        return answer;
    };
}

// Globals with their changes along u and v, and what else differs by point; spaces are told apart.
std::vector<rsl::KernelKey> point_keys() {
    std::vector<rsl::KernelKey> keys = {rsl::plain_key(rsl::KeyKind::One),
                                        rsl::plain_key(rsl::KeyKind::Rng)};
    for (const rsl::GlobalInfo& global : rsl::globals())
        for (int k = 0; k < rsl::component_count(global.type.base); ++k) {
            rsl::KernelKey key = rsl::global_key(global.id, k);
            for (rsl::Partial partial : {rsl::Partial::None, rsl::Partial::Du, rsl::Partial::Dv}) {
                key.partial = partial;
                if (find_column(key) != kNoColumn) keys.push_back(key);
            }
        }
    return keys;
}

// The columns of one point.
class PointRow {
  public:
    PointRow() {
        for (size_t c = 0; c < kColVarying; ++c) rows_[c] = numbers_[c];
    }
    void fill(const Patch& patch, size_t point) {
        PatchPoints points(patch, point);
        fill_columns(points, {1, rows_});
    }
    double number(const rsl::KernelKey& key) const {
        float value = numbers_[find_column(key)][0];
        return key.kind == rsl::KeyKind::Rng ? double(jit::bits_of(value)) : double(value);
    }

  private:
    float numbers_[kColVarying][jit::kMaxLanes];
    float* rows_[kColVarying];
};

rsl::ReferenceInputs frame_inputs(const ShadeStack& stack, const Patch& patch,
                                  const ShadeKernel& kernel) {
    rsl::ReferenceInputs inputs;
    for (const auto& [key, value] : stack.values) inputs.values[rsl::text(key)] = double(value);
    std::vector<std::string> spaces = kernel.unknown_spaces();
    spaces.insert(spaces.end(), {"world", "object", "shader", "screen", "NDC", "raster"});
    for (const std::string& space : spaces)
        for (bool to_current : {true, false})
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column) {
                    rsl::KernelKey key = rsl::space_key(space, to_current, row, column);
                    inputs.values[rsl::text(key)] = double(frame_number(patch, key));
                }
    auto add = [&](const rsl::KernelKey& key) {
        inputs.values[rsl::text(key)] = double(frame_number(patch, key));
    };
    add(rsl::plain_key(rsl::KeyKind::CameraNear));
    add(rsl::plain_key(rsl::KeyKind::CameraFar));
    for (const rsl::GlobalInfo& global : rsl::globals())
        for (int k = 0; k < rsl::component_count(global.type.base); ++k)
            if (rsl::KernelKey key = rsl::global_key(global.id, k); find_column(key) == kNoColumn)
                add(key);
    for (const ShadeLight& light : shade_lights()) {
        rsl::ReferenceLight& out = inputs.lights.emplace_back();
        out.kind = light.kind;
        for (size_t k = 0; k < 3; ++k) {
            out.L[k] = double(light.L[int(k)]);
            out.Cl[k] = double(light.Cl[int(k)]);
            out.Ol[k] = 1;
        }
    }
    return inputs;
}

}  // namespace

void compare_with_interpreter(const ShadeStack& stack, const Patch& patch,
                              const ShadeKernel& kernel, Diagnostics& diagnostics) {
    ShadeKernel other;
    if (!other.compile(stack, jit::find_target("interp"), diagnostics)) return;
    other.bind(stack, patch);
    other.run();
    ShadeOutputs wanted = other.outputs();
    size_t differing = 0, total = 0;
    Worst worst;
    for (const auto& [name, values] : kernel.outputs())
        for (size_t i = 0; i < values.size(); ++i, ++total) {
            float w = wanted[name][i];
            if (same_bits(values[i], w)) continue;
            ++differing;
            worst.meet(double(values[i]), double(w), name, i);
        }
    std::printf("interp: %zu of %zu values differ in bits\n", differing, total);
    worst.print(patch);
}

ReferenceRun run_over_reference(const ShadeStack& stack, const Patch& patch,
                                const ShadeKernel& kernel) {
    rsl::ReferenceInputs inputs = frame_inputs(stack, patch, kernel);
    inputs.service = reference_service(patch, kernel);
    const std::vector<rsl::KernelKey> keys = point_keys();
    auto row = std::make_unique<PointRow>();
    ReferenceRun result;
    size_t step = std::max<size_t>(1, (patch.count() + kReferencePoints - 1) / kReferencePoints);
    for (size_t i = 0; i < patch.count(); i += step) {
        row->fill(patch, i);
        for (const rsl::KernelKey& key : keys) inputs.values[rsl::text(key)] = row->number(key);
        rsl::ReferenceResult exact = rsl::run_reference<double>(stack.layers, inputs);
        rsl::ReferenceResult single = rsl::run_reference<float>(stack.layers, inputs);
        result.missing = exact.missing;
        if (!exact.missing.empty()) return result;
        if (exact.decisions != single.decisions)
            ++result.undecided;
        else
            result.points.push_back({i, std::move(exact.values)});
    }
    for (const jit::ServiceInfo& service : kernel.pair().point->services)
        if (service.name == rsl::service_name(rsl::Service::texture) ||
            service.name == rsl::service_name(rsl::Service::environment))
            result.unfiltered.push_back(service.name);
    return result;
}

void compare_with_reference(const ShadeStack& stack, const Patch& patch,
                            const ShadeKernel& kernel) {
    const ReferenceRun run = run_over_reference(stack, patch, kernel);
    if (!run.missing.empty()) {
        std::printf("reference: has no meaning for '%s' yet\n", run.missing.c_str());
        return;
    }
    ShadeOutputs outputs = kernel.outputs();
    Worst worst;
    for (const ReferencePoint& point : run.points)
        for (const auto& [name, values] : outputs)
            if (auto found = point.values.find(name); found != point.values.end())
                worst.meet(double(values[point.index]), found->second, name, point.index);
    for (const std::string& service : run.unfiltered)
        std::printf("reference: reads %s unfiltered, so large pixels differ\n", service.c_str());
    std::printf("reference: %zu points compared, %zu near a decision left out\n", run.points.size(),
                run.undecided);
    worst.print(patch);
    if (!run.points.empty() && worst.difference == 0) std::printf("no difference\n");
}

}  // namespace kinora
