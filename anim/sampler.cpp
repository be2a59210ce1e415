// anim/sampler.cpp: a document's key arrays made ready to evaluate.
#include "anim/sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "anim/curve_p.h"

namespace kinora::anim {
namespace {

// Tangents of one side (IN or OUT) as the file lays them out.
struct TangentArray {
    enum Layout : uint8_t { None, OneD, Pairs, SharedTime };
    Layout layout = None;
    std::span<const double> numbers;
    uint32_t key_stride = 1;

    Tangent at(size_t key, uint32_t component) const {
        if (layout == None || (key + 1) * key_stride > numbers.size()) return {};
        const double* k = &numbers[key * key_stride];
        if (layout == OneD) return {Tangent::OneD, 0, k[component]};
        if (layout == Pairs) return {Tangent::TwoD, k[2 * component], k[2 * component + 1]};
        return {Tangent::TwoD, k[0], k[1 + component]};
    }
};

TangentArray tangent_array(std::span<const double> numbers, uint32_t key_stride, uint32_t stride,
                           SamplerRepairs& repairs) {
    TangentArray array{TangentArray::None, numbers, key_stride};
    if (numbers.empty()) return array;
    if (key_stride == stride)
        array.layout = TangentArray::OneD;
    else if (key_stride == 2 * stride)
        array.layout = TangentArray::Pairs;
    else if (key_stride == stride + 1)
        array.layout = TangentArray::SharedTime;
    else
        repairs.bad_stride = 1;
    return array;
}

bool all_finite(std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
}

// Indices of the usable keys in order of time.
std::vector<size_t> ordered_keys(const SamplerSource& source, SamplerRepairs& repairs) {
    size_t stride = std::max(1u, source.stride);
    size_t count = std::min(source.times.size(), source.values.size() / stride);
    repairs.missing_values += static_cast<uint32_t>(source.times.size() - count);
    std::vector<size_t> keys;
    keys.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        if (std::isfinite(source.times[i]) && all_finite(source.values.subspan(i * stride, stride)))
            keys.push_back(i);
        else
            ++repairs.non_finite_keys;
    }
    uint32_t backward = 0;
    for (size_t i = 1; i < keys.size(); ++i)
        backward += source.times[keys[i]] < source.times[keys[i - 1]];
    repairs.unsorted_keys += backward;
    if (backward)
        std::stable_sort(keys.begin(), keys.end(),
                         [&](size_t a, size_t b) { return source.times[a] < source.times[b]; });
    return keys;
}

Interpolation interpolation_of(const SamplerSource& source, size_t key) {
    std::span<const Interpolation> all = source.interpolations;
    if (all.empty()) return Interpolation::Linear;
    return all[std::min(key, all.size() - 1)];
}

void copy_keys(const SamplerSource& source, std::span<const size_t> keys, Sampler& sampler) {
    sampler.times.reserve(keys.size());
    sampler.values.reserve(keys.size() * sampler.stride);
    sampler.interpolations.reserve(keys.size());
    for (size_t key : keys) {
        auto value = source.values.subspan(key * sampler.stride, sampler.stride);
        sampler.times.push_back(source.times[key]);
        sampler.values.insert(sampler.values.end(), value.begin(), value.end());
        sampler.interpolations.push_back(interpolation_of(source, key));
    }
}

// Value of key k, continued in a line beyond the ends.
double value_around(const Sampler& sampler, ptrdiff_t k, uint32_t component) {
    ptrdiff_t last = static_cast<ptrdiff_t>(sampler.times.size()) - 1;
    auto value = [&](ptrdiff_t i) { return sampler.values[i * sampler.stride + component]; };
    if (k < 0) return value(0) + (value(0) - value(1));
    if (k > last) return value(last) + (value(last) - value(last - 1));
    return value(k);
}

Tangent checked(Tangent tangent, const InterpolationRow& interpolation, SamplerRepairs& repairs) {
    if (!interpolation.uses_tangents) return {};
    if (std::isfinite(tangent.time) && std::isfinite(tangent.value)) return tangent;
    ++repairs.bad_tangents;
    return {};
}

// All curves of all segments, as soon as one segment is curved.
void build_curves(const SamplerSource& source, std::span<const size_t> keys, Sampler& sampler,
                  SamplerRepairs& repairs) {
    auto curved = [](Interpolation i) { return row(i).shape != nullptr; };
    if (keys.size() < 2 ||
        std::none_of(sampler.interpolations.begin(), sampler.interpolations.end() - 1, curved))
        return;
    TangentArray in = tangent_array(source.in_tangents, source.in_stride, sampler.stride, repairs);
    TangentArray out =
        tangent_array(source.out_tangents, source.out_stride, sampler.stride, repairs);
    sampler.curves.reserve((keys.size() - 1) * sampler.stride);
    for (size_t k = 0; k + 1 < keys.size(); ++k) {
        const InterpolationRow& interpolation = row(sampler.interpolations[k]);
        double duration = sampler.times[k + 1] - sampler.times[k];
        bool missing = false;
        for (uint32_t c = 0; c < sampler.stride; ++c) {
            auto around = [&](int step) {
                return value_around(sampler, static_cast<ptrdiff_t>(k) + step, c);
            };
            SegmentKeys segment{around(-1),       around(0), around(1), around(2),
                                sampler.times[k], duration,  {},        {}};
            if (duration > 0) {  // a segment without length is never met
                Tangent left = out.at(keys[k], c), right = in.at(keys[k + 1], c);
                missing |= left.form == Tangent::Missing || right.form == Tangent::Missing;
                segment.out = checked(left, interpolation, repairs);
                segment.in = checked(right, interpolation, repairs);
            }
            sampler.curves.push_back(make_curve(interpolation, segment, repairs));
        }
        repairs.missing_tangents += missing && interpolation.uses_tangents;
    }
}

void decompose_keys(Sampler& sampler) {
    sampler.rigid.reserve(sampler.times.size());
    for (size_t k = 0; k < sampler.times.size(); ++k) {
        Matrix16 m;
        std::copy_n(&sampler.values[k * 16], 16, m.begin());
        sampler.rigid.push_back(decompose(m));
    }
}

}  // namespace

std::string to_text(const SamplerRepairs& r) {
    const std::pair<uint32_t, const char*> told[] = {
        {r.missing_values, "keys without values dropped"},
        {r.non_finite_keys, "keys that are not finite dropped"},
        {r.unsorted_keys, "keys out of order sorted"},
        {r.missing_tangents, "segments without tangents made straight"},
        {r.bad_tangents, "tangents that are not finite made straight"},
        {r.clamped_tangents, "tangents moved into their segment"},
        {r.bad_stride, "unfitting stride"},
    };
    std::string text;
    for (auto [count, what] : told)
        if (count) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
    return text;
}

Sampler make_sampler(const SamplerSource& source, SamplerRepairs* repairs) {
    SamplerRepairs own;
    SamplerRepairs& counts = repairs ? *repairs : own;
    Sampler sampler;
    sampler.stride = std::max(1u, source.stride);
    sampler.pre = source.pre;
    sampler.post = source.post;
    sampler.kind = source.kind;
    bool fits = sampler.kind == SampleKind::Matrix       ? sampler.stride == 16
                : sampler.kind == SampleKind::Quaternion ? sampler.stride == 4
                                                         : true;
    if (!fits) {
        sampler.kind = SampleKind::Numbers;
        counts.bad_stride = 1;
    }
    std::vector<size_t> keys = ordered_keys(source, counts);
    copy_keys(source, keys, sampler);
    for (size_t k = 1; k < keys.size(); ++k)
        counts.duplicate_times += sampler.times[k] == sampler.times[k - 1];
    build_curves(source, keys, sampler, counts);
    if (sampler.kind == SampleKind::Matrix) decompose_keys(sampler);
    return sampler;
}

}  // namespace kinora::anim
