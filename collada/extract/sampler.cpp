// collada/extract/sampler.cpp: <sampler>: keys, interpolations and tangents, made consistent.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

struct InterpolationRow {
    std::string_view name;
    Interpolation interpolation;
    bool tangents;
};
constexpr InterpolationRow kInterpolations[] = {
    {"LINEAR", Interpolation::Linear, false},     {"STEP", Interpolation::Step, false},
    {"BEZIER", Interpolation::Bezier, true},      {"HERMITE", Interpolation::Hermite, true},
    {"CARDINAL", Interpolation::Cardinal, false}, {"BSPLINE", Interpolation::Bspline, false}};

struct BehaviorRow {
    std::string_view name;
    Behavior behavior;
};
// The words of 1.5's attributes, then those of MAYA's pre_infinity and post_infinity.
constexpr BehaviorRow kBehaviors[] = {
    {"UNDEFINED", Behavior::Undefined}, {"CONSTANT", Behavior::Constant},
    {"GRADIENT", Behavior::Gradient},   {"CYCLE", Behavior::Cycle},
    {"OSCILLATE", Behavior::Oscillate}, {"CYCLE_RELATIVE", Behavior::CycleRelative},
    {"LINEAR", Behavior::Gradient}};

bool has_tangents(Interpolation interpolation) {
    return kInterpolations[size_t(interpolation)].tangents;
}

struct SamplerReader {
    Extraction& x;
    Link link;
    Sampler& sampler;
    Link input, output, interpolation, in_tangent, out_tangent;
    size_t written_keys = 0;  // times in the file

    bool find_sources();
    bool read_keys();
    void read_interpolation();
    void read_tangents();
    void drop_bad_keys();
    void sort_keys();
    void drop_missing_tangents();
    void read_behaviors();

  private:
    std::vector<double> read_tangent(Link source, uint8_t& dims);
    void keep_keys(const std::vector<uint32_t>& keys);
    Behavior behavior(std::string_view attribute, std::string_view extra);
    size_t key_count() const { return sampler.times.size(); }
};

bool SamplerReader::find_sources() {
    struct {
        std::string_view semantic;
        Link* to;
    } rows[] = {{"INPUT", &input},
                {"OUTPUT", &output},
                {"INTERPOLATION", &interpolation},
                {"IN_TANGENT", &in_tangent},
                {"OUT_TANGENT", &out_tangent}};
    for (auto& row : rows)
        if (const Element* e = find_input(*link.element, row.semantic))
            *row.to = resolve(x, {link.doc, e}, "source", {"source"});
    for (auto& row : {rows[0], rows[1]})
        if (!*row.to) {
            x.diag.report(Code::ANIM_SAMPLER, x.where(link), row.semantic);
            return false;
        }
    return true;
}

bool SamplerReader::read_keys() {
    DoubleSource times = read_double_source(x, input);
    DoubleSource values = read_double_source(x, output);
    size_t keys = written_keys = times.count;
    for (size_t k = 0; k < keys; ++k) sampler.times.push_back(times.values[k * times.stride]);
    bool flattened = keys > 0 && values.count != keys && values.stride == 1 &&
                     values.count % keys == 0 && values.count / keys <= 16;
    if (flattened) {  // an accessor without its stride
        values.stride = uint32_t(values.count / keys);
        values.count = keys;
    }
    if (values.count != keys)
        x.diag.report(Code::ANIM_COUNT, x.where(link),
                      fmt::format("{} key times, {} values", keys, values.count));
    keys = std::min(keys, values.count);
    if (keys == 0) {
        x.diag.report(Code::ANIM_EMPTY, x.where(link));
        return false;
    }
    uint64_t numbers = keys + values.values.size() * 5;  // tangents of two numbers on both sides
    if (!x.budget.reserve(sizeof(Sampler) + numbers * sizeof(double), x.where(link))) return false;
    sampler.stride = values.stride;
    sampler.times.resize(keys);
    sampler.values = std::move(values.values);
    sampler.values.resize(keys * sampler.stride);
    return true;
}

void SamplerReader::read_interpolation() {
    sampler.interpolation.assign(key_count(), Interpolation::Linear);
    if (!interpolation) return;
    NameSource names = read_name_source(x, interpolation);
    if (names.names.size() != written_keys)
        x.diag.report(
            Code::ANIM_COUNT, x.where(interpolation),
            fmt::format("{} interpolations for {} keys", names.names.size(), written_keys));
    bool reported = false;
    for (size_t k = 0; k < std::min(key_count(), names.names.size()); ++k) {
        auto row = std::find_if(std::begin(kInterpolations), std::end(kInterpolations),
                                [&](const auto& r) { return r.name == names.names[k]; });
        if (row != std::end(kInterpolations))
            sampler.interpolation[k] = row->interpolation;
        else if (!std::exchange(reported, true))
            x.diag.report(Code::ANIM_INTERP_UNKNOWN, x.where(interpolation), names.names[k]);
    }
}

// Tangents as [key][component][dims]; what a file does not have is NaN. dims: 0 when unusable.
std::vector<double> SamplerReader::read_tangent(Link source, uint8_t& dims) {
    dims = 0;
    DoubleSource data = read_double_source(x, source);
    size_t n = sampler.stride, keys = key_count();
    if (data.values.empty()) return {};
    // An accessor that forgot its stride gives one number an entry.
    if (data.stride == 1 && data.count != keys && data.count % keys == 0) {
        data.stride = uint32_t(data.count / keys);
        data.count = keys;
    }
    if (data.count != written_keys)
        x.diag.report(Code::ANIM_COUNT, x.where(source),
                      fmt::format("{} tangents for {} keys", data.count, written_keys));
    bool shared_time = n > 1 && data.stride == n + 1;  // one time for all components
    if (data.stride == n)
        dims = 1;
    else if (data.stride == 2 * n || shared_time)
        dims = 2;
    if (dims == 0) {
        x.diag.report(Code::ANIM_TANGENT_DIM, x.where(source), data.stride, n, 2 * n);
        return {};
    }
    std::vector<double> tangents(keys * n * dims, std::nan(""));
    for (size_t k = 0; k < std::min(keys, data.count); ++k) {
        const double* from = &data.values[k * data.stride];
        double* to = &tangents[k * n * dims];
        if (!shared_time) std::copy_n(from, n * dims, to);
        for (size_t c = 0; shared_time && c < n; ++c) {
            to[2 * c] = from[0];
            to[2 * c + 1] = from[1 + c];
        }
    }
    return tangents;
}

void SamplerReader::read_tangents() {
    bool needed =
        std::any_of(sampler.interpolation.begin(), sampler.interpolation.end(), has_tangents);
    if (!needed || !in_tangent || !out_tangent) return;
    uint8_t in_dims = 0, out_dims = 0;
    sampler.in_tangents = read_tangent(in_tangent, in_dims);
    sampler.out_tangents = read_tangent(out_tangent, out_dims);
    if (in_dims == out_dims && in_dims > 0) {
        sampler.tangent_dims = in_dims;
        return;
    }
    if (in_dims && out_dims)
        x.diag.report(Code::ANIM_TANGENT_DIM, x.where(out_tangent), sampler.stride * out_dims,
                      sampler.stride * in_dims, sampler.stride * in_dims);
    sampler.in_tangents.clear();
    sampler.out_tangents.clear();
}

template <class T>
void pick(std::vector<T>& list, const std::vector<uint32_t>& keys, size_t width) {
    if (list.empty()) return;
    std::vector<T> kept;
    kept.reserve(keys.size() * width);
    for (uint32_t k : keys)
        kept.insert(kept.end(), list.begin() + std::ptrdiff_t(k * width),
                    list.begin() + std::ptrdiff_t((k + 1) * width));
    list = std::move(kept);
}

void SamplerReader::keep_keys(const std::vector<uint32_t>& keys) {
    size_t tangent_width = size_t(sampler.stride) * sampler.tangent_dims;
    pick(sampler.times, keys, 1);
    pick(sampler.values, keys, sampler.stride);
    pick(sampler.interpolation, keys, 1);
    pick(sampler.in_tangents, keys, tangent_width);
    pick(sampler.out_tangents, keys, tangent_width);
}

void SamplerReader::drop_bad_keys() {
    std::vector<uint32_t> good;
    for (uint32_t k = 0; k < key_count(); ++k) {
        bool finite = std::isfinite(sampler.times[k]);
        for (size_t c = 0; c < sampler.stride; ++c)
            finite = finite && std::isfinite(sampler.values[size_t(k) * sampler.stride + c]);
        if (finite) good.push_back(k);
    }
    if (good.size() == key_count()) return;
    x.diag.report(Code::ANIM_KEY_NAN, x.where(link), key_count() - good.size());
    keep_keys(good);
}

void SamplerReader::sort_keys() {
    if (std::is_sorted(sampler.times.begin(), sampler.times.end())) return;
    x.diag.report(Code::ANIM_TIME_ORDER, x.where(input));
    std::vector<uint32_t> order(key_count());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return sampler.times[a] < sampler.times[b]; });
    keep_keys(order);
}

// A curved segment needs the out tangent of its left key and the in tangent of its right one.
void SamplerReader::drop_missing_tangents() {
    size_t missing = 0, width = size_t(sampler.stride) * sampler.tangent_dims;
    auto finite = [&](const std::vector<double>& tangents, size_t key) {
        for (size_t i = 0; i < width; ++i)
            if (!std::isfinite(tangents[key * width + i])) return false;
        return width > 0;
    };
    for (size_t k = 0; k < key_count(); ++k) {
        if (!has_tangents(sampler.interpolation[k])) continue;
        bool last = k + 1 == key_count();
        bool whole =
            width > 0 &&
            (last || (finite(sampler.out_tangents, k) && finite(sampler.in_tangents, k + 1)));
        if (whole) continue;
        sampler.interpolation[k] = Interpolation::Linear;
        missing += !last;
    }
    if (missing) x.diag.report(Code::ANIM_TANGENT_MISSING, x.where(link), missing);
    for (auto* tangents : {&sampler.in_tangents, &sampler.out_tangents})
        for (double& t : *tangents)
            if (!std::isfinite(t)) t = 0;
}

Behavior SamplerReader::behavior(std::string_view attribute, std::string_view extra) {
    std::string_view word = link.element->value(attribute);
    // FCollada puts them into a technique of the input source or of the sampler's extra.
    for (const Element* owner : {input.element, output.element, link.element->child("extra")})
        for (const Element* t = owner && word.empty() ? owner->child("technique") : nullptr; t;
             t = t->next_named("technique"))
            if (const Element* e = t->child(extra)) word = trim(e->text);
    for (const BehaviorRow& row : kBehaviors)
        if (row.name == word) return row.behavior;
    return Behavior::Undefined;
}

void SamplerReader::read_behaviors() {
    sampler.pre = behavior("pre_behavior", "pre_infinity");
    sampler.post = behavior("post_behavior", "post_infinity");
}

}  // namespace

bool read_sampler(Extraction& x, Link link, Sampler& sampler) {
    sampler.id = link.element->value("id");
    sampler.where = x.where(link);
    SamplerReader reader{x, link, sampler, {}, {}, {}, {}, {}};
    if (!reader.find_sources() || !reader.read_keys()) return false;
    reader.read_interpolation();
    reader.read_tangents();
    reader.drop_bad_keys();
    if (sampler.times.empty()) {
        x.diag.report(Code::ANIM_EMPTY, sampler.where);
        return false;
    }
    reader.sort_keys();
    reader.drop_missing_tangents();
    reader.read_behaviors();
    return true;
}

}  // namespace kinora::collada
