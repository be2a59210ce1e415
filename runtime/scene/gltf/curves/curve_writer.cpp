// runtime/scene/gltf/curves/curve_writer.cpp: curves as glTF's channels and samplers.
#include "runtime/scene/gltf/curves/curve_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace kinora {

namespace {

// How far a curve gets from where it begins, and its largest number.
struct CurveExtent {
    double moves = 0, size = 0;
};

CurveExtent extent_of(const PropertyCurve& curve, const std::vector<double>& first) {
    CurveExtent extent;
    std::vector<double> now(curve.width);
    auto look = [&](double time) {
        curve.at(time, now.data());
        extent.moves = std::max(extent.moves, curve.distance(first.data(), now.data()));
        for (double number : now) extent.size = std::max(extent.size, std::abs(number));
    };
    for (size_t k = 0; k < curve.times.size(); ++k) {
        look(curve.times[k]);
        if (k + 1 < curve.times.size())
            for (double s : kProbes)
                look(curve.times[k] + s * (curve.times[k + 1] - curve.times[k]));
    }
    return extent;
}

Json target_of(uint32_t node, const PropertyCurve& curve) {
    if (!curve.is_pointer()) return {{"node", node}, {"path", curve.name}};
    return {{"path", "pointer"}, {"extensions", {{kAnimationPointer, {{"pointer", curve.name}}}}}};
}

// A number, or a list of them.
std::vector<double> numbers_of(const Json& value) {
    return value.is_number() ? std::vector<double>{value.get<double>()}
                             : value.get<std::vector<double>>();
}

}  // namespace

struct CurveWriter::Output {
    Json channels = Json::array(), samplers = Json::array();
};

// Lists that no type of an accessor holds are scalars one after the other, as weights are.
uint32_t PropertyCurve::element_width() const {
    bool has_type = width <= 4 || width == 16;
    return name == "weights" || !has_type ? 1 : width;
}

CurveWriter::CurveWriter(std::span<const Take> takes, double error, GltfDocument& document,
                         BufferWriter& buffer)
    : takes_(takes), error_(error), document_(document), buffer_(buffer), outputs_(takes.size()) {}

CurveWriter::~CurveWriter() = default;

void CurveWriter::add_channel(uint32_t take, uint32_t node, const PropertyCurve& curve,
                              const std::vector<double>& times, const std::vector<double>& numbers,
                              const char* interpolation) {
    auto [input, fresh] = key_accessors_.try_emplace(times, 0);
    if (fresh)
        input->second =
            buffer_.accessor(std::vector<float>(times.begin(), times.end()), 1, 0, true);
    uint32_t output = buffer_.accessor(std::vector<float>(numbers.begin(), numbers.end()),
                                       curve.element_width(), 0, false);
    Output& to = outputs_[take];
    to.channels.push_back({{"sampler", to.samplers.size()}, {"target", target_of(node, curve)}});
    if (curve.is_pointer()) document_.use_extension(kAnimationPointer);
    to.samplers.push_back(
        {{"input", input->second}, {"interpolation", interpolation}, {"output", output}});
}

// Steps alone: the values at the keys, held.
bool CurveWriter::add_step(uint32_t take, uint32_t node, const PropertyCurve& curve) {
    for (const MovingChannel& c : curve.channels)
        for (size_t k = 0; k + 1 < c.sampler->interpolations.size(); ++k)
            if (c.sampler->interpolations[k] != anim::Interpolation::Step) return false;
    std::vector<double> numbers(curve.times.size() * curve.width);
    for (size_t k = 0; k < curve.times.size(); ++k)
        curve.at(curve.times[k], &numbers[k * curve.width]);
    add_channel(take, node, curve, curve.times, numbers, "STEP");
    return true;
}

bool CurveWriter::add_spline(uint32_t take, uint32_t node, const PropertyCurve& curve,
                             uint32_t first_value) {
    if (curve.channels.empty()) return false;
    const std::vector<double>& keys = curve.channels[0].sampler->times;
    bool curved = false;
    for (const MovingChannel& c : curve.channels) {
        const anim::Sampler& s = *c.sampler;
        if (s.times != keys || keys.size() < 2 || keys[0] < 0 || distinct_times(keys) != keys ||
            s.kind != anim::SampleKind::Numbers || s.pre != anim::Behaviour::Constant ||
            s.post != anim::Behaviour::Constant)
            return false;
        for (size_t k = 0; k + 1 < keys.size(); ++k) {
            if (s.interpolations[k] == anim::Interpolation::Step) return false;
            if (s.interpolations[k] == anim::Interpolation::Linear) continue;
            curved = true;
            for (uint32_t i = 0; i < c.channel->count; ++i)
                if (!s.curves[k * s.stride + c.channel->component + i].linear_time) return false;
        }
    }
    if (!curved) return false;
    uint32_t width = curve.width;
    std::vector<double> numbers(keys.size() * 3 * width, 0.0);  // in tangent, value, out tangent
    for (size_t k = 0; k < keys.size(); ++k) curve.at(keys[k], &numbers[(3 * k + 1) * width]);
    for (const MovingChannel& c : curve.channels)
        for (uint32_t i = 0; i < c.channel->count; ++i) {
            uint32_t number = c.channel->slot + i * c.channel->slot_step - first_value;
            if (number >= width) return false;
            const anim::Sampler& s = *c.sampler;
            for (size_t k = 0; k + 1 < keys.size(); ++k) {
                double duration = keys[k + 1] - keys[k];
                size_t at = k * s.stride + c.channel->component + i;
                double out, in;
                if (s.interpolations[k] == anim::Interpolation::Linear) {
                    size_t value = k * s.stride + c.channel->component + i;
                    out = in = (s.values[value + s.stride] - s.values[value]) / duration;
                } else {
                    const double* v = s.curves[at].value;
                    out = 3 * (v[1] - v[0]) / duration;
                    in = 3 * (v[3] - v[2]) / duration;
                }
                numbers[(3 * k + 2) * width + number] = out;
                numbers[(3 * (k + 1)) * width + number] = in;
            }
        }
    add_channel(take, node, curve, keys, numbers, "CUBICSPLINE");
    return true;
}

// Straight pieces.
void CurveWriter::add_sampled(uint32_t take, uint32_t node, const PropertyCurve& curve) {
    StraightKeys keys = reduce_keys(curve, curve.times, curve.tolerance);
    if (keys.worst > 0.01 * curve.tolerance) {  // less is rounding
        ++sampled_;
        worst_error_ = std::max(worst_error_, keys.worst * error_ / curve.tolerance);
    }
    add_channel(take, node, curve, keys.times, keys.numbers, "LINEAR");
}

void CurveWriter::add(uint32_t take, uint32_t node, PropertyCurve curve) {
    if (curve.times.empty()) return;
    std::vector<double> first(curve.width);
    curve.at(curve.times[0], first.data());
    CurveExtent extent = extent_of(curve, first);
    double still = 1e-12 * std::max(extent.size, 1e-12);
    if (extent.moves <= still) return add_still(take, node, curve, first, still);
    curve.tolerance = error_;
    bool is_scale = curve.name == "scale";
    if (!curve.rotation) curve.tolerance *= is_scale ? extent.size : extent.moves;
    if (add_step(take, node, curve)) return;
    add_sampled(take, node, curve);
}

void CurveWriter::add_still(uint32_t take, uint32_t node, const PropertyCurve& curve,
                            const std::vector<double>& numbers, double tolerance) {
    std::string pointer =
        curve.is_pointer() ? curve.name : fmt::format("/nodes/{}/{}", node, curve.name);
    const Json* own = document_.find(pointer);
    if (takes_.size() == 1) {
        document_.set(pointer, own && own->is_number() ? Json(numbers[0]) : Json(numbers));
        return;
    }
    std::vector<double> rest(curve.width, curve.name == "scale" ? 1.0 : 0.0);
    if (curve.rotation) rest[3] = 1;
    if (own) rest = numbers_of(*own);
    if (curve.distance(rest.data(), numbers.data()) > tolerance)
        add_channel(take, node, curve, {curve.times[0]}, numbers, "STEP");
}

bool CurveWriter::has_channels(uint32_t take) const {
    return !outputs_[take].channels.empty();
}

void CurveWriter::write_animations() {
    for (uint32_t t = 0; t < takes_.size(); ++t) {
        if (!has_channels(t)) continue;
        Json animation = {{"channels", outputs_[t].channels}, {"samplers", outputs_[t].samplers}};
        if (!takes_[t].name.empty()) animation["name"] = takes_[t].name;
        if (takes_[t].is_whole) animation["extras"]["kinora_whole"] = true;
        document_.add("animations", std::move(animation));
    }
}

void CurveWriter::report(LossReport& losses) const {
    losses.sampled(sampled_, worst_error_);
}

}  // namespace kinora
