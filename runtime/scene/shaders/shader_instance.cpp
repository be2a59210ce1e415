// runtime/scene/shaders/shader_instance.cpp: parameters and spaces bound to compiled shaders.
#include "runtime/scene/shaders/shader_instance.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/check.h"
#include "runtime/scene/description/given_globals.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shaders/scene_host.h"
#include "runtime/scene/spaces.h"

namespace kinora {

FrameInput parameter_input(const ShaderInstance& look, const rsl::KernelKey& key) {
    FrameInput input;
    if (key.layer >= look.layers.size()) return input;
    const ShaderUse& use = look.layers[key.layer];
    const std::string& name = rsl::name_of(key);
    const ParamSource* source = use.find(name);
    uint32_t element = uint32_t(std::max(key.element, 0)), component = key.component;
    for (const rsl::ShaderParameter& parameter : use.shader->parameters) {
        if (parameter.name != name || !source) continue;
        if (parameter.type.base == rsl::BaseType::String) {
            std::string text =
                element < source->strings.size() ? source->strings[element] : std::string();
            input.fixed = jit::float_of(rsl::intern(text));
            return input;
        }
        uint32_t width = uint32_t(rsl::component_count(parameter.type.base));
        uint32_t needed = width * uint32_t(std::max(parameter.type.array_length, 1));
        bool spatial = rsl::is_spatial(parameter.type.base);
        input.source = spatial ? FrameInput::Source::Spatial : FrameInput::Source::Value;
        input.type = parameter.type.base;
        input.component = key.component;
        uint32_t c = element * width + (spatial ? 0 : component);
        if (source->by_columns && width == 16)
            c = element * width + component % 4 * 4 + component / 4;
        input.index = source->value.component(needed, c);
        if (spatial && source->value.count < 3) {  // one number for all three: no point to speak of
            input.source = FrameInput::Source::Value;
            input.index = source->value.offset;
        }
        return input;
    }
    if (source && is_given_global(name) && source->value.present()) {
        input.source = FrameInput::Source::Value;
        input.index = source->value.component(3, component);
    }
    return input;
}

dvec3 parameter_in_current(rsl::BaseType type, const dmat4& current_from_shader, const double* v) {
    dvec3 value(v[0], v[1], v[2]);
    if (type == rsl::BaseType::Point) return dvec3(current_from_shader * dvec4(value, 1.0));
    dmat3 linear(current_from_shader);
    if (type == rsl::BaseType::Normal) return glm::transpose(glm::inverse(linear)) * value;
    return linear * value;
}

namespace {

class SceneNumbers : public FrameNumbers {
  public:
    SceneNumbers(const FrameContext& context, std::span<const dmat4> current_from_space,
                 std::span<const FrameInput> inputs)
        : context_(context), current_from_space_(current_from_space), inputs_(inputs) {}
    float number(size_t index) const override;

  private:
    // From "current" to a space of the look, inverted once for its sixteen numbers.
    const dmat4& space_from_current(uint32_t space) const;

    const FrameContext& context_;
    std::span<const dmat4> current_from_space_;
    std::span<const FrameInput> inputs_;
    mutable uint32_t inverted_ = kNone;  // the space of
    mutable dmat4 inverse_{};
};

const dmat4& SceneNumbers::space_from_current(uint32_t space) const {
    if (inverted_ != space) inverse_ = glm::inverse(current_from_space_[space]);
    inverted_ = space;
    return inverse_;
}

float SceneNumbers::number(size_t index) const {
    using Source = FrameInput::Source;
    const FrameInput& input = inputs_[index];
    const Pose& pose = context_.pose;
    switch (input.source) {
        case Source::Fixed:
            return input.fixed;
        case Source::Value:
            return float(pose.values[input.index]);
        case Source::Spatial: {
            const dmat4& m = current_from_space_[input.space];
            return float(
                parameter_in_current(input.type, m, &pose.values[input.index])[input.component]);
        }
        case Source::Space: {
            int row = input.component / 4, column = input.component % 4;
            return float((input.inverse ? space_from_current(input.index)
                                        : current_from_space_[input.index])[column][row]);
        }
        case Source::Time:
            return float(pose.time);
        case Source::Shutter:
            return float(pose.shutter);
        case Source::Near:
            return float(pose.view.znear);
        case Source::Far:
            return float(pose.view.zfar);
        case Source::Eye:
            return float(context_.eye[input.component]);
    }
    return 0;
}

}  // namespace

namespace {

void run_frame_kernel(const SceneKernel& kernel, const FrameContext& context, FrameHost& host,
                      std::span<const dmat4> current_from_space, FrameBlock& block) {
    kernel.run_frame(block, SceneNumbers(context, current_from_space, kernel.inputs), host, {},
                     context.stop);
    host.show_printed();
}

void run_full(const ShaderInstance& look, const FrameContext& context, InstanceFrame& frame) {
    FrameHost host(context.scene, context.pose, look);
    run_frame_kernel(look.full, context, host, frame.current_from_space, frame.full);
    frame.prints_asked = host.printed().asked();
    frame.prints_shown = host.printed().shown();
}

}  // namespace

void ShaderInstance::update_for_vertices(const FrameContext& context, uint32_t object,
                                         InstanceFrame& frame) const {
    frame.current_from_space.resize(spaces.size());
    for (size_t s = 0; s < spaces.size(); ++s)
        frame.current_from_space[s] =
            object_from_space(context.nodes, context.pose, spaces[s], object);
    run_full(*this, context, frame);
}

void ShaderInstance::update(const FrameContext& context, InstanceFrame& frame) const {
    frame.current_from_space.resize(spaces.size());
    for (size_t s = 0; s < spaces.size(); ++s)
        frame.current_from_space[s] =
            current_from_space(context.nodes, context.pose, spaces[s], space_owner());
    run_full(*this, context, frame);
    if (!opacity) return;
    FrameHost host(context.scene, context.pose, *this);
    run_frame_kernel(*opacity, context, host, frame.current_from_space, frame.opacity);
}

}  // namespace kinora
