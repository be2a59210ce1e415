// runtime/programs/shade/kernel.cpp: lowers, compiles and runs shaders over a patch.
#include "runtime/programs/shade/kernel.h"
#include "runtime/programs/common/standard_streams.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "jit/ir/kernel_call.h"
#include "raytrace/accel.h"
#include "runtime/base/stats.h"
#include "runtime/scene/kernels/columns.h"

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

class StackNumbers : public FrameNumbers {
  public:
    StackNumbers(const ShadeStack& stack, const Patch& patch, const jit::KernelPair& pair)
        : stack_(stack), patch_(patch), pair_(pair) {}
    float number(size_t index) const override {
        rsl::KernelKey key = rsl::key_of(pair_.frame->inputs[index]);
        auto value = stack_.values.find(key);
        return value != stack_.values.end() ? value->second : frame_number(patch_, key);
    }

  private:
    const ShadeStack& stack_;
    const Patch& patch_;
    const jit::KernelPair& pair_;
};

}  // namespace

bool ShadeKernel::compile(const ShadeStack& stack, const jit::Target* target,
                          Diagnostics& diagnostics,
                          std::vector<std::pair<std::string, std::string>>* dumps) {
    Stopwatch watch;
    std::optional<rsl::LoweredShader> lowered = rsl::lower(stack.layers, stack.lower, diagnostics);
    if (!lowered) return false;
    lower_ms = watch.ms();
    lowered_ = std::move(*lowered);
    if (!stack.derivatives)  // inputs without any have none to hand on
        for (jit::InputInfo& input : lowered_.module.inputs) input.du = input.dv = "";
    jit::KernelPair pair =
        jit::compile(std::move(lowered_.module), {target, dumps, &diagnostics.files});
    if (!pair.point) return false;
    bound_.bind(std::move(pair), find_column);
    return true;
}

float* ShadeKernel::column(size_t count, float value) {
    float* data = arena_.allocate_span<float>(jit::padded(count)).data();
    std::fill_n(data, jit::padded(count), value);
    return data;
}

void ShadeKernel::bind(const ShadeStack& stack, const Patch& patch) {
    stack_ = &stack;
    patch_ = &patch;
    columns_ = arena_.allocate_span<float*>(kColVarying);
    std::fill(columns_.begin(), columns_.end(), nullptr);
    for (uint16_t wanted : bound_.columns) columns_[wanted] = column(patch.count(), 0);
    PatchPoints points(patch);
    fill_columns(points, {patch.count(), columns_});
    out_ = take_outputs(bound_.kernel(), patch.count(), arena_);
    faults_.assign(bound_.kernel().fault_sites.size(), 0);
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
            columns[rsl::kLightBare + k] = columns[rsl::kLightCl + k];
            columns[rsl::kLightOl + k] = column(kSlice, 1);
        }
        columns[rsl::kLightLit] = column(kSlice, jit::float_of(1));
        float* uniforms = column(rsl::kLightUniforms + lowered_.light_messages.size(), 0);
        uniforms[rsl::kLightKind] = jit::float_of(light.kind);
        uniforms[rsl::kLightHandle] = jit::float_of(int32_t(records_.size()));
        records_.push_back({columns.data(), uniforms});
    }
    record_sets_[kPatchLights] = {int32_t(records_.size()), records_.data()};
}

void ShadeKernel::run() {
    std::optional<raytrace::DenormalGuard> flush;  // the fast tier's mode
    if (stack_->lower.math == jit::math::Tier::Fast) flush.emplace();
    prints_.clear();
    PatchHost host(*patch_, prints_);
    bound_.run_frame(frame_, StackNumbers(*stack_, *patch_, bound_.pair), host, record_sets_);
    for (size_t at = 0; at < patch_->count(); at += kSlice) {
        Arena::Mark mark = arena_.mark();
        bound_.run({.first = at,
                    .count = std::min(kSlice, patch_->count() - at),
                    .frame = frame_,
                    .columns = columns_,
                    .out = out_,
                    .faults = faults_,
                    .record_sets = record_sets_,
                    .host = host},
                   arena_);
        arena_.release(mark);
    }
    prints_.show(print_to(stdout));
}

ShadeOutputs ShadeKernel::outputs() const {
    ShadeOutputs outputs;
    for (size_t o = 0; o < out_.size(); ++o) {
        const jit::OutputInfo& info = bound_.kernel().outputs[o];
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
    look(bound_.kernel());
    if (bound_.pair.frame) look(*bound_.pair.frame);
    return unknown;
}

void ShadeKernel::report_faults(Diagnostics& diagnostics) const {
    auto faulted = [&](size_t site) { return faults_[site] != 0; };
    kinora::report_faults(bound_.kernel(), faulted, diagnostics);
    bound_.report_frame_faults(frame_, diagnostics);
    if (stack_) prints_.report(stack_->layers.front().shader->name, diagnostics);
}

}  // namespace kinora
