// runtime/scene/kernels/bound_kernel.cpp: kernels with all they need, launched.
#include "runtime/scene/kernels/bound_kernel.h"

#include <algorithm>
#include <bit>

#include "jit/ir/kernel_call.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/kernels/kernel_probe.h"

namespace kinora {

namespace {

std::vector<jit::ServiceFn> services_of(const jit::Kernel& kernel) {
    std::vector<jit::ServiceFn> services;
    for (const jit::ServiceInfo& service : kernel.services)
        services.push_back(find_service(service.name));
    return services;
}

float* take_row(Arena& arena, size_t count) {
    return arena.allocate_span<float>(jit::padded(count)).data();
}

}  // namespace

void BoundKernel::bind(jit::KernelPair kernels,
                       const std::function<uint16_t(const rsl::KernelKey&)>& column_of) {
    pair = std::move(kernels);
    for (const jit::InputInfo& input : pair.point->inputs)
        columns.push_back(column_of(rsl::key_of(input)));
    services = services_of(*pair.point);
    if (!pair.frame) return;
    frame_services = services_of(*pair.frame);
}

void BoundKernel::size(FrameBlock& block) const {
    const jit::Kernel& kernel = *pair.frame;
    for (size_t i = 0; i < kernel.inputs.size(); ++i)
        block.in_.push_back(take_row(block.arena_, 1));
    for (size_t o = 0; o < kernel.outputs.size(); ++o)
        block.out_.push_back(take_row(block.arena_, 1));
    block.numbers.resize(size_t(pair.point->frame_slots));
    block.faults.resize(kernel.fault_sites.size());
}

void BoundKernel::run_frame(FrameBlock& block, const FrameNumbers& numbers, KernelHost& host,
                            std::span<const jit::RecordSet> record_sets,
                            const std::atomic<int>* stop) const {
    if (!pair.frame) return;
    const jit::Kernel& kernel = *pair.frame;
    if (block.numbers.empty() && block.out_.empty()) size(block);
    bool stands = block.ran_ && frame_services.empty() && record_sets.empty();
    for (size_t i = 0; i < block.in_.size(); ++i) {
        const float number = numbers.number(i);
        float* const row = block.in_[i];
        stands = stands && std::bit_cast<uint32_t>(number) == std::bit_cast<uint32_t>(*row);
        std::fill_n(row, jit::padded(1), number);
    }
    if (stands) return;
    std::ranges::fill(block.faults, uint8_t(0));
    Arena::Mark mark = block.arena_.mark();
    jit::KernelCall{.kernel = kernel,
                    .count = 1,
                    .in = {const_cast<const float* const*>(block.in_.data()), block.in_.size()},
                    .out = block.out_,
                    .row_floats = jit::padded(1),
                    .scratch = block.arena_.allocate_span<std::byte>(kernel.scratch_bytes),
                    .faults = block.faults,
                    .services = frame_services,
                    .record_sets = record_sets,
                    .host = &host,
                    .stop = stop}
        .run();
    block.arena_.release(mark);
    for (size_t i = 0; i < block.numbers.size(); ++i) block.numbers[i] = block.out_[i][0];
    block.ran_ = !stop || stop->load(std::memory_order_relaxed) == 0;
}

void BoundKernel::report_frame_faults(const FrameBlock& block, Diagnostics& diagnostics) const {
    if (!pair.frame || block.faults.empty()) return;
    auto faulted = [&](size_t site) { return block.faults[site] != 0; };
    report_faults(*pair.frame, faulted, diagnostics);
}

namespace {
KernelProbe* g_probe = nullptr;
}
void probe_kernels(KernelProbe* probe) {
    g_probe = probe;
}

void BoundKernel::run(const PointLaunch& launch, Arena& arena) const {
    if (launch.stop && launch.stop->load(std::memory_order_relaxed) != 0) {
        for (float* row : launch.out) std::fill_n(row + launch.first, launch.count, 0.0f);
        return;
    }
    std::span<const float*> in = arena.allocate_span<const float*>(columns.size());
    for (size_t i = 0; i < in.size(); ++i) in[i] = launch.columns[columns[i]] + launch.first;
    std::span<float*> out = arena.allocate_span<float*>(launch.out.size());
    for (size_t o = 0; o < out.size(); ++o) out[o] = launch.out[o] + launch.first;
    const jit::KernelCall call{.kernel = kernel(),
                               .count = launch.count,
                               .in = in,
                               .out = out,
                               .row_floats = jit::padded(launch.count),
                               .frame = launch.frame.numbers,
                               .scratch = arena.allocate_span<std::byte>(kernel().scratch_bytes),
                               .faults = launch.faults,
                               .services = services,
                               .record_sets = launch.record_sets,
                               .host = &launch.host,
                               .stop = launch.stop};
    if (g_probe) [[unlikely]]
        g_probe->run(call);
    else
        call.run();
}

std::span<float*> take_outputs(const jit::Kernel& kernel, size_t count, Arena& arena) {
    std::span<float*> out = arena.allocate_span<float*>(kernel.outputs.size());
    for (float*& row : out) row = take_row(arena, count);
    return out;
}

void report_fault(const jit::FaultSite& site, Diagnostics& diagnostics) {
    diagnostics.report(Code::SHADER_FAULT, site.where, site.message);
}

}  // namespace kinora
