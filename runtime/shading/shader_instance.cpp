// runtime/shading/shader_instance.cpp: parameters and spaces bound to compiled shaders.
#include "runtime/shading/shader_instance.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/check.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/spaces.h"
#include "runtime/shading/grid.h"
#include "runtime/shading/scene_host.h"

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
    return input;
}

void ShaderInstance::update_for_vertices(const FrameContext& context, uint32_t object) {
    for (size_t s = 0; s < spaces.size(); ++s)
        current_from_space[s] = object_from_space(context.scene, spaces[s], object);
    full.update(context, *this);
}

void ShaderInstance::update(const FrameContext& context) {
    for (size_t s = 0; s < spaces.size(); ++s)
        current_from_space[s] = kinora::current_from_space(context.scene, spaces[s], space_owner());
    full.update(context, *this);
    if (opacity) opacity->update(context, *this);
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
    SceneNumbers(const FrameContext& context, const ShaderInstance& look,
                 std::span<const FrameInput> inputs)
        : context_(context), look_(look), inputs_(inputs) {}
    float number(size_t index) const override;

  private:
    // From "current" to a space of the look, inverted once for its sixteen numbers.
    const dmat4& space_from_current(uint32_t space) const;

    const FrameContext& context_;
    const ShaderInstance& look_;
    std::span<const FrameInput> inputs_;
    mutable uint32_t inverted_ = kNone;  // the space of
    mutable dmat4 inverse_{};
};

const dmat4& SceneNumbers::space_from_current(uint32_t space) const {
    if (inverted_ != space) inverse_ = glm::inverse(look_.current_from_space[space]);
    inverted_ = space;
    return inverse_;
}

float SceneNumbers::number(size_t index) const {
    using Source = FrameInput::Source;
    const FrameInput& input = inputs_[index];
    const Scene& scene = context_.scene;
    switch (input.source) {
        case Source::Fixed:
            return input.fixed;
        case Source::Value:
            return float(scene.values[input.index]);
        case Source::Spatial: {
            const dmat4& m = look_.current_from_space[input.space];
            return float(
                parameter_in_current(input.type, m, &scene.values[input.index])[input.component]);
        }
        case Source::Space: {
            int row = input.component / 4, column = input.component % 4;
            return float((input.inverse ? space_from_current(input.index)
                                        : look_.current_from_space[input.index])[column][row]);
        }
        case Source::Time:
            return float(scene.time);
        case Source::Shutter:
            return float(scene.shutter);
        case Source::Near:
            return float(scene.view.znear);
        case Source::Far:
            return float(scene.view.zfar);
        case Source::Eye:
            return float(context_.eye[input.component]);
    }
    return 0;
}

}  // namespace

void SceneKernel::update(const FrameContext& context, const ShaderInstance& look) {
    SceneHost host(context.scene, look);
    run_frame(SceneNumbers(context, look, inputs), host, {}, context.stop);
    host.printed().show();
    prints_asked = host.printed().asked();
    prints_shown = host.printed().shown();
}

}  // namespace kinora
