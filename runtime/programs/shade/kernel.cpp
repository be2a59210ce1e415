// runtime/programs/shade/kernel.cpp: lowers, compiles and runs shaders over a patch.
#include "runtime/programs/shade/kernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "jit/ir/kernel_call.h"
#include "raytrace/accel.h"
#include "runtime/base/check.h"
#include "runtime/base/stats.h"
#include "runtime/description/findings.h"

namespace kinora {

namespace {

constexpr size_t kSlice = 1024;  // points in one call, as the renderer has it

const std::vector<float>& output(const ShadeOutputs& outputs, const std::string& name,
                                 const std::vector<float>& missing) {
    auto found = outputs.find(name);
    return found == outputs.end() ? missing : found->second;
}

// What a light's statements give a white matte surface that faces the eye or the sphere's outside.
ShadeOutputs illuminate(const ShadeOutputs& light, const rsl::LoweredShader& lowered,
                        const Patch& patch) {
    ShadeOutputs result;
    std::vector<float> missing(patch.count(), 0.0f);
    auto of_Ci = [&](int k) -> std::vector<float>& {
        return result[rsl::text(rsl::global_key(rsl::Global::Ci, k))];
    };
    for (int k = 0; k < 3; ++k) of_Ci(k) = missing;
    for (size_t s = 0; s < lowered.light_statements.size(); ++s) {
        auto of_light = [&](rsl::LightColumn column, int k) -> const std::vector<float>& {
            return output(light, rsl::text(rsl::light_key(s, column, k)), missing);
        };
        const std::vector<float>* L[3];
        for (int k = 0; k < 3; ++k) L[k] = &of_light(rsl::kLightL, k);
        for (int k = 0; k < 3; ++k) {
            const std::vector<float>& Cl = of_light(rsl::kLightCl, k);
            std::vector<float>& Ci = of_Ci(k);
            for (size_t i = 0; i < patch.count(); ++i) {
                vec3 to_light((*L[0])[i], (*L[1])[i], (*L[2])[i]);
                float length = glm::length(to_light);
                float cosine = glm::dot(to_light, patch[i].N) / length;
                if (lowered.light_statements[s].kind == rsl::kLightAmbient) cosine = 1;
                Ci[i] += Cl[i] * (cosine > 0 ? cosine : 0.0f);
            }
        }
    }
    return result;
}

}  // namespace

bool ShadeKernel::compile(const ShadeStack& stack, const jit::Target* target,
                          Diagnostics& diagnostics,
                          std::vector<std::pair<std::string, std::string>>* dumps) {
    Stopwatch watch;
    std::optional<rsl::LoweredShader> lowered = rsl::lower(stack.layers, stack.lower, diagnostics);
    if (!lowered) return false;
    lower_ms = watch.ms();
    lowered_ = std::move(*lowered);
    pair_ = jit::compile(std::move(lowered_.module), {target, dumps, &diagnostics.files});
    return pair_.point != nullptr;
}

float* ShadeKernel::column(size_t count, float value) {
    float* data = arena_.allocate_span<float>(jit::padded(count)).data();
    std::fill_n(data, jit::padded(count), value);
    return data;
}

void ShadeKernel::bind(const ShadeStack& stack, const Patch& patch) {
    stack_ = &stack;
    patch_ = &patch;
    const jit::Kernel& kernel = *pair_.point;
    for (const jit::InputInfo& info : kernel.inputs) {
        float* data = column(patch.count(), 0);
        PatchInput input(patch, rsl::key_of(info));
        CHECK(input.found);
        for (size_t i = 0; i < jit::padded(patch.count()) && patch.count() > 0; ++i)
            data[i] = input.value(patch[std::min(i, patch.count() - 1)]);
        in_.push_back(data);
    }
    for (size_t o = 0; o < kernel.outputs.size(); ++o) out_.push_back(column(patch.count(), 0));
    for (const jit::ServiceInfo& service : kernel.services)
        services_.push_back(find_service(service.name));
    faults_.assign(kernel.fault_sites.size() + 1, 0);
    size_t scratch = kernel.scratch_bytes;
    if (pair_.frame) {
        for (const jit::ServiceInfo& service : pair_.frame->services)
            frame_services_.push_back(find_service(service.name));
        frame_faults_.assign(pair_.frame->fault_sites.size() + 1, 0);
        scratch = std::max(scratch, pair_.frame->scratch_bytes);
    }
    scratch_ = arena_.allocate_span<std::byte>(scratch);
    fill_records();
}

void ShadeKernel::fill_records() {
    size_t messages = 0;
    for (int components : lowered_.light_message_components) messages += size_t(components);
    const float* zeros = column(kSlice, 0);
    for (const ShadeLight& light : shade_lights()) {
        auto columns = arena_.allocate_span<const float*>(rsl::kLightMessages + messages);
        std::fill(columns.begin(), columns.end(), zeros);
        for (size_t k = 0; k < 3; ++k) {
            columns[rsl::kLightL + k] = column(kSlice, light.L[int(k)]);
            columns[rsl::kLightCl + k] = column(kSlice, light.Cl[int(k)]);
            columns[rsl::kLightOl + k] = column(kSlice, 1);
        }
        columns[rsl::kLightLit] = column(kSlice, jit::float_of(1));
        float* uniforms = column(rsl::kLightUniforms + lowered_.light_messages.size(), 0);
        uniforms[rsl::kLightKind] = jit::float_of(light.kind);
        records_.push_back({columns.data(), uniforms});
    }
    record_sets_[kPatchLights] = {int32_t(records_.size()), records_.data()};
}

void ShadeKernel::run_frame() {
    if (!pair_.frame) return;
    const jit::Kernel& kernel = *pair_.frame;
    Arena::Mark mark = arena_.mark();
    PatchHost host(*patch_);
    std::vector<const float*> in;
    for (const jit::InputInfo& info : kernel.inputs) {
        auto value = stack_->values.find(rsl::key_of(info));
        PatchInput input(*patch_, rsl::key_of(info));
        in.push_back(
            column(1, value != stack_->values.end() ? value->second : input.value(PatchPoint{})));
    }
    std::vector<float*> out;
    for (size_t o = 0; o < kernel.outputs.size(); ++o) out.push_back(column(1, 0));
    jit::KernelCall{.kernel = kernel,
                    .count = 1,
                    .in = in,
                    .out = out,
                    .row_floats = jit::padded(1),
                    .scratch = scratch_,
                    .faults = frame_faults_,
                    .services = frame_services_,
                    .record_sets = record_sets_,
                    .host = static_cast<KernelHost*>(&host)}
        .run();
    frame_.clear();
    for (float* value : out) frame_.push_back(*value);
    arena_.release(mark);
}

void ShadeKernel::run() {
    std::optional<raytrace::DenormalGuard> flush;  // the fast tier's mode
    if (stack_->lower.math == jit::math::Tier::Fast) flush.emplace();
    run_frame();
    std::vector<const float*> in(in_.size());
    std::vector<float*> out(out_.size());
    PatchHost host(*patch_);
    jit::KernelCall call{.kernel = *pair_.point,
                         .in = in,
                         .out = out,
                         .frame = frame_,
                         .scratch = scratch_,
                         .faults = faults_,
                         .services = services_,
                         .record_sets = record_sets_,
                         .host = static_cast<KernelHost*>(&host)};
    for (size_t at = 0; at < patch_->count(); at += kSlice) {
        for (size_t k = 0; k < in.size(); ++k) in[k] = in_[k] + at;
        for (size_t k = 0; k < out.size(); ++k) out[k] = out_[k] + at;
        call.count = std::min(kSlice, patch_->count() - at);
        call.row_floats = jit::padded(patch_->count()) - at;
        call.run();
    }
}

ShadeOutputs ShadeKernel::outputs() const {
    ShadeOutputs outputs;
    for (size_t o = 0; o < out_.size(); ++o) {
        const jit::OutputInfo& info = pair_.point->outputs[o];
        std::vector<float>& values = outputs[info.name];
        values = {out_[o], out_[o] + patch_->count()};
        if (info.type == jit::Type::I)
            for (float& value : values) value = float(jit::bits_of(value));
    }
    return outputs;
}

ShadeOutputs ShadeKernel::illumination() const {
    return illuminate(outputs(), lowered_, *patch_);
}

std::vector<std::string> ShadeKernel::unknown_spaces() const {
    constexpr std::string_view kStandard[] = {"world",  "object", "shader",
                                              "screen", "NDC",    "raster"};
    std::vector<std::string> unknown;
    auto look = [&](const jit::Kernel& kernel) {
        for (const jit::InputInfo& input : kernel.inputs) {
            rsl::KernelKey key = rsl::key_of(input);
            if (!key.is_space()) continue;
            const std::string& space = rsl::name_of(key);
            bool known = std::count(std::begin(kStandard), std::end(kStandard), space) +
                             std::count(unknown.begin(), unknown.end(), space) >
                         0;
            if (!known) unknown.push_back(space);
        }
    };
    look(*pair_.point);
    if (pair_.frame) look(*pair_.frame);
    return unknown;
}

void ShadeKernel::report_faults(Diagnostics& diagnostics) const {
    auto report = [&](const jit::Kernel& kernel, const std::vector<uint8_t>& faults) {
        for (size_t i = 0; i < kernel.fault_sites.size(); ++i)
            if (faults[i])
                diagnostics.report(Code::SHADER_FAULT, kernel.fault_sites[i].where,
                                   kernel.fault_sites[i].message);
    };
    report(*pair_.point, faults_);
    if (pair_.frame) report(*pair_.frame, frame_faults_);
}

}  // namespace kinora
