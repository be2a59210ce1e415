// runtime/scene/dae/import_animation.cpp: COLLADA's channels and samplers for anim.
#include <algorithm>

#include "runtime/scene/dae/import_p.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

constexpr anim::Interpolation kInterpolations[] = {  // by collada::Interpolation
    anim::Interpolation::Linear,  anim::Interpolation::Step,     anim::Interpolation::Bezier,
    anim::Interpolation::Hermite, anim::Interpolation::Cardinal, anim::Interpolation::Bspline};
constexpr anim::Behaviour kBehaviours[] = {  // by collada::Behavior
    anim::Behaviour::Constant, anim::Behaviour::Constant,  anim::Behaviour::Linear,
    anim::Behaviour::Cycle,    anim::Behaviour::Oscillate, anim::Behaviour::CycleRelative};

// Swaps rows and columns of every 4x4 whose entries are `width` numbers each.
void transpose_matrices(std::vector<double>& numbers, size_t width) {
    if (numbers.empty() || width == 0) return;
    std::vector<double> original = numbers;
    size_t matrix = 16 * width;
    for (size_t begin = 0; begin + matrix <= numbers.size(); begin += matrix)
        for (size_t column = 0; column < 4; ++column)
            for (size_t row = 0; row < 4; ++row)
                for (size_t k = 0; k < width; ++k)
                    numbers[begin + (row * 4 + column) * width + k] =
                        original[begin + (column * 4 + row) * width + k];
}

anim::Sampler make_sampler(const collada::Sampler& from, bool matrix,
                           anim::SamplerRepairs& repairs) {
    collada::Sampler s = from;
    if (matrix) {
        transpose_matrices(s.values, 1);
        transpose_matrices(s.in_tangents, s.tangent_dims);
        transpose_matrices(s.out_tangents, s.tangent_dims);
    }
    std::vector<anim::Interpolation> interpolations;
    for (collada::Interpolation i : s.interpolation)
        interpolations.push_back(kInterpolations[size_t(i)]);
    anim::SamplerSource source;
    source.times = s.times;
    source.values = s.values;
    source.stride = s.stride;
    source.interpolations = interpolations;
    source.in_tangents = s.in_tangents;
    source.out_tangents = s.out_tangents;
    source.in_stride = source.out_stride = s.stride * std::max<uint32_t>(1, s.tangent_dims);
    source.pre = kBehaviours[size_t(s.pre)];
    source.post = kBehaviours[size_t(s.post)];
    source.kind = matrix ? anim::SampleKind::Matrix : anim::SampleKind::Numbers;
    return anim::make_sampler(source, &repairs);
}

}  // namespace

void ColladaImport::import_animation() {
    out_.animated.assign(out_.values.size(), false);
    sampler_told_.assign(data_.samplers.size(), false);
    out_.animation = animation_of(std::vector<bool>(data_.channels.size(), true));
}

// A <float4x4>, which `values` hold by columns (allocate_values).
bool ColladaImport::is_matrix_param(const collada::TargetRef& ref) const {
    if (ref.kind == collada::Owner::EffectParam)
        return data_.effects[ref.owner].params[ref.slot].value.type == collada::ParamType::Float4x4;
    return ref.kind == collada::Owner::MaterialParam &&
           data_.materials[ref.owner].setparams[ref.slot].value.type ==
               collada::ParamType::Float4x4;
}

anim::Animation ColladaImport::animation_of(const std::vector<bool>& wanted) {
    std::vector<anim::Sampler> samplers;
    std::vector<anim::Channel> channels;
    std::map<std::pair<uint32_t, bool>, uint32_t> made;  // one for each sampler and kind
    for (size_t c = 0; c < data_.channels.size(); ++c) {
        if (!wanted[c]) continue;
        const collada::Channel& from = data_.channels[c];
        const collada::TargetRef& ref = from.ref;
        bool matrix = ref.whole_matrix;
        auto [known, is_new] = made.try_emplace({from.sampler, matrix}, uint32_t(samplers.size()));
        if (is_new) {
            anim::SamplerRepairs repairs;
            samplers.push_back(make_sampler(data_.samplers[from.sampler], matrix, repairs));
            std::string text = to_text(repairs);
            if (!text.empty() && !sampler_told_[from.sampler])
                diagnostics_.report(Code::ANIM_KEYS_REPAIRED, data_.samplers[from.sampler].where,
                                    from.target, text);
            sampler_told_[from.sampler] = true;
        }
        uint32_t base = slot(ref).offset - ref.first;
        // Elements of a <matrix> are numbered by columns there and kept by rows here, those of a
        // <float4x4> by rows there and kept by columns.
        bool element = is_matrix_param(ref) || (ref.kind == collada::Owner::Transform && !matrix &&
                                                data_.nodes[ref.owner].transforms[ref.slot].kind ==
                                                    collada::TransformKind::Matrix);
        uint32_t stride = data_.samplers[from.sampler].stride;
        for (uint32_t k = 0; k < ref.count; ++k) {
            uint32_t number = ref.first + k;
            if (element) number = number / 16 * 16 + anim::matrix_slot(number % 16 / 4, number % 4);
            out_.animated[base + number] = true;
            if (matrix && k > 0) continue;
            anim::Channel channel;
            channel.sampler = known->second;
            channel.component = stride == 1 ? 0 : k;
            channel.slot = base + number;
            channel.count = matrix ? 16 : 1;
            channel.owner = owner_bit(ref);
            channels.push_back(channel);
        }
    }
    return anim::make_animation(std::move(samplers), std::move(channels));
}

}  // namespace kinora
