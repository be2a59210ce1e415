// runtime/programs/shade/points_kernel.cpp: compiles shaders and runs them over points of a file.
#include "runtime/programs/shade/points_kernel.h"
#include "runtime/programs/common/standard_streams.h"

#include <algorithm>

#include "jit/ir/kernel_call.h"
#include "runtime/programs/shade/points_host.h"
#include "runtime/programs/shade/points_lights.h"

namespace kinora {

bool PointsKernel::compile(const PointsStack& stack, const jit::Target* target,
                           Diagnostics& diagnostics) {
    std::optional<rsl::LoweredShader> lowered = rsl::lower(stack.layers, stack.lower, diagnostics);
    if (!lowered) return false;
    lowered_ = std::move(*lowered);
    jit::KernelPair pair =
        jit::compile(std::move(lowered_.module), {target, nullptr, &diagnostics.files});
    if (!pair.point) return false;
    uint16_t next = 0;  // each input has a row of its own
    bound_.bind(std::move(pair), [&](const rsl::KernelKey&) { return next++; });
    return true;
}

std::span<float* const> PointsKernel::run(size_t count, const FillRow& fill, KernelHost& host,
                                          std::span<const jit::RecordSet> record_sets,
                                          Arena& arena) {
    const jit::Kernel& kernel = bound_.kernel();
    std::span<float*> rows = arena.allocate_span<float*>(kernel.inputs.size());
    for (size_t i = 0; i < rows.size(); ++i) {
        std::span<float> row = arena.allocate_span<float>(jit::padded(count));
        fill(rsl::key_of(kernel.inputs[i]), row);
        rows[i] = row.data();
    }
    std::span<float*> out = take_outputs(kernel, count, arena);
    faults_.resize(kernel.fault_sites.size());
    bound_.run({.first = 0,
                .count = count,
                .frame = frame_,
                .columns = rows,
                .out = out,
                .faults = faults_,
                .record_sets = record_sets,
                .host = host},
               arena);
    return out;
}

void PointsKernel::run(const PointSet& points, const PointsStack& stack, TextureStore& textures,
                       PointsLights* lights) {
    count_ = points.count();
    auto fill = [&](const rsl::KernelKey& key, std::span<float> row) {
        points.fill(key, stack.numbers, stack.current_from_shader, row);
    };
    PointsHost host(points, textures, lights);
    host.set_shader_space(stack.current_from_shader);
    std::span<const jit::RecordSet> records = host.at_points(arena_);
    bound_.run_frame(frame_, PointsFrameNumbers(points, stack, bound_.pair), host, records);
    out_ = run(points.count(), fill, host, records, arena_);
    shader_ = stack.layers.back().shader->name;
    printed_ = host.printed();
    printed_.show(print_to(stderr));
}

int PointsKernel::find_output(const rsl::KernelKey& key) const {
    const auto& outputs = bound_.kernel().outputs;
    for (size_t o = 0; o < outputs.size(); ++o)
        if (rsl::key_of(outputs[o]) == key) return int(o);
    return -1;
}

std::span<const float> PointsKernel::output(const rsl::KernelKey& key) const {
    int found = find_output(key);
    if (found < 0) return {};
    return {out_[size_t(found)], count_};
}

void PointsKernel::report(Diagnostics& diagnostics) const {
    printed_.report(shader_, diagnostics);
    kinora::report_faults(
        bound_.kernel(), [&](size_t site) { return site < faults_.size() && faults_[site] != 0; },
        diagnostics);
    bound_.report_frame_faults(frame_, diagnostics);
}

}  // namespace kinora
