// runtime/player/display.cpp: tone curves, AOVs and false colors.
#include "runtime/player/display.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "runtime/player/bytes/shown_bytes.h"

namespace kinora {

namespace {

float luminance(vec3 c) {  // of linear sRGB primaries, IEC 61966-2-1
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

// K. Narkowicz, ACES Filmic Tone Mapping Curve, 2015.
float filmic(float x) {
    x = std::max(x, 0.0f);
    return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

// A film of three numbers a pixel, opaque where `covered`.
template <class F>
raytrace::Film film_of(int width, int height, F&& value) {
    raytrace::Film film(width, height);
    for (size_t k = 0; k < film.rgba.size(); ++k) film.rgba[k] = value(k);
    return film;
}

std::string base_of(const std::string& plane) {
    size_t dot = plane.rfind('.');
    bool letter = dot != plane.npos && dot + 2 == plane.size() &&
                  std::string_view("RGBAXYZxyuvst").find(plane[dot + 1]) != std::string_view::npos;
    return !letter ? plane : plane.substr(0, dot);
}

std::vector<const raytrace::AovPlane*> planes_of(const raytrace::Film& film,
                                                 const std::string& name) {
    std::vector<const raytrace::AovPlane*> planes;
    for (const raytrace::AovPlane& plane : film.aovs)
        if (base_of(plane.name) == name) planes.push_back(&plane);
    return planes;
}

struct Range {
    float low = 0, high = 1;
};

// The least and the largest; 0 to 1 where there are none.
Range range_of(const std::vector<float>& numbers) {
    Range range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (float v : numbers) {
        if (!std::isfinite(v) || v >= raytrace::kNoDepth) continue;
        range.low = std::min(range.low, v);
        range.high = std::max(range.high, v);
    }
    if (!(range.low <= range.high)) return {};
    if (range.low == range.high) range.high = range.low + 1;
    return range;
}

// Numbers as grays or false colors from their least to their largest.
raytrace::Film of_numbers(const raytrace::Film& film, const std::vector<float>& numbers,
                          bool in_color) {
    const Range range = range_of(numbers);
    return film_of(film.width, film.height, [&](size_t k) {
        float at = (numbers[k] - range.low) / (range.high - range.low);
        return vec4(in_color ? false_color(at) : vec3(at), 1.0f);
    });
}

vec3 color_of_number(uint32_t number) {
    if (number == kNone) return vec3(0.0f);
    uint32_t h = (number + 1) * 0x9e3779b9u;
    h = (h ^ h >> 15) * 0x85ebca6bu;
    h ^= h >> 13;
    return vec3(float(h & 255), float(h >> 8 & 255), float(h >> 16 & 255)) / 300.0f + 0.1f;
}

raytrace::Film of_guide(const raytrace::Film& film, const PictureGuide& guide,
                        const DisplaySettings& settings) {
    if (settings.aov == "depth") return of_numbers(film, guide.depth, settings.false_color);
    bool normals = settings.aov == "Ng";
    return film_of(film.width, film.height, [&](size_t k) {
        bool there = guide.surface[k] != kNone;
        vec3 c = normals ? 0.5f * guide.Ng[k] + 0.5f : color_of_number(guide.surface[k]);
        return there ? vec4(c, 1.0f) : vec4(0.0f);
    });
}

// What only one pixel in fifty exceeds, which an interrupted thread may; 1 if that is 0.
float hot(std::vector<float> numbers) {
    auto most = numbers.begin() + std::ptrdiff_t(numbers.size() - 1 - numbers.size() / 50);
    std::nth_element(numbers.begin(), most, numbers.end());
    return *most > 0 ? *most : 1.0f;
}

// Heat: false colors from 0 to hot(). Costs of a smaller film are enlarged as they are.
raytrace::Film of_costs(const raytrace::Film& film, const PixelCosts& costs,
                        const std::string& aov) {
    if (costs.empty()) return raytrace::Film(film.width, film.height);
    const std::vector<float> numbers = cost_numbers(costs, aov);
    const float scale = 1 / hot(numbers);
    return film_of(film.width, film.height, [&](size_t k) {
        const size_t x = k % size_t(film.width) * size_t(costs.width) / size_t(film.width);
        const size_t y = k / size_t(film.width) * size_t(costs.height) / size_t(film.height);
        const float heat = numbers[y * size_t(costs.width) + x] * scale;
        return vec4(false_color(std::min(heat, 1.0f)), 1.0f);
    });
}

raytrace::Film of_aov(const raytrace::Film& film, const DisplaySettings& settings) {
    auto planes = planes_of(film, settings.aov);
    if (planes.empty()) return raytrace::Film(film.width, film.height);
    if (planes.size() < 2) return of_numbers(film, planes[0]->values, settings.false_color);
    return film_of(film.width, film.height, [&](size_t k) {
        vec3 c(planes[0]->values[k], planes[1]->values[k], 0);
        if (planes.size() > 2) c.z = planes[2]->values[k];
        return vec4(settings.false_color ? false_color(luminance(c)) : c, 1.0f);
    });
}

raytrace::Film of_picture(const raytrace::Film& film, const DisplaySettings& settings) {
    return film_of(film.width, film.height, [&](size_t k) {
        vec4 pixel = film.rgba[k];
        if (settings.false_color) return vec4(false_color(luminance(vec3(pixel))), 1.0f);
        if (!(pixel.w > 0)) return pixel;
        vec3 c = vec3(pixel) / pixel.w;
        return vec4(vec3(filmic(c.x), filmic(c.y), filmic(c.z)) * pixel.w, pixel.w);
    });
}

void put_kept(const Picture& kept, double wipe_at, int width, int height,
              std::vector<uint8_t>& out) {
    if (kept.width <= 0 || kept.height <= 0) return;
    const auto columns = size_t(std::lround(std::clamp(wipe_at, 0.0, 1.0) * width));
    const auto wide = size_t(kept.width), high = size_t(kept.height);
    for (size_t y = 0; y < size_t(height); ++y) {
        const uint8_t* from = &kept.rgba[4 * (y * high / size_t(height)) * wide];
        uint8_t* to = &out[4 * y * size_t(width)];
        if (kept.width == width) {
            std::memcpy(to, from, 4 * columns);
            continue;
        }
        for (size_t x = 0; x < columns; ++x)  // the window has another size by now
            std::memcpy(to + 4 * x, from + 4 * (x * wide / size_t(width)), 4);
    }
}

}  // namespace

bool shows_guide(const std::string& aov) {
    return aov == "depth" || aov == "Ng" || aov == "surface";
}

namespace {

struct CostRow {
    const char* name;
    std::vector<float> PixelCosts::*plane;
};
constexpr CostRow kCosts[] = {
    {"shading_ns", &PixelCosts::ns},
    {"rays", &PixelCosts::rays},
    {"lanes", &PixelCosts::filled},
    {"samples", &PixelCosts::points},
};

const CostRow* find_cost(const std::string& aov) {
    auto found = std::ranges::find_if(kCosts, [&](const CostRow& row) { return aov == row.name; });
    return found == std::end(kCosts) ? nullptr : found;
}

}  // namespace

bool shows_costs(const std::string& aov) {
    return find_cost(aov);
}

std::vector<float> cost_numbers(const PixelCosts& costs, const std::string& aov) {
    const CostRow* row = find_cost(aov);
    if (!row) return {};
    std::vector<float> numbers = costs.*row->plane;
    if (row->plane == &PixelCosts::filled)
        for (size_t k = 0; k < numbers.size(); ++k)
            numbers[k] = costs.lanes[k] > 0 ? numbers[k] / costs.lanes[k] : 0.0f;
    return numbers;
}

std::vector<std::string> shown_names(const std::vector<raytrace::AovPlane>& planes) {
    std::vector<std::string> names{""};
    for (const raytrace::AovPlane& plane : planes) {
        std::string name = base_of(plane.name);
        if (shows_guide(name) || shows_costs(name)) continue;  // those of below show the same
        if (plane.in_file && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    names.insert(names.end(), {"depth", "Ng", "surface"});
    for (const CostRow& row : kCosts) names.emplace_back(row.name);
    return names;
}

std::optional<NumberScale> number_scale(const raytrace::Film& film, const PictureGuide& guide,
                                        const PixelCosts& costs, const DisplaySettings& settings) {
    const std::string& aov = settings.aov;
    if (shows_costs(aov)) {
        if (costs.empty()) return std::nullopt;
        return NumberScale{0, double(hot(cost_numbers(costs, aov))), true};
    }
    const auto planes = planes_of(film, aov);
    if (aov == "depth" || (!aov.empty() && !shows_guide(aov) && planes.size() == 1)) {
        const Range range = range_of(aov == "depth" ? guide.depth : planes[0]->values);
        return NumberScale{double(range.low), double(range.high), settings.false_color};
    }
    if (!settings.false_color || shows_guide(aov)) return std::nullopt;
    return NumberScale{0, 1, true};  // of luminances
}

std::vector<float> shown_numbers(const Picture& picture, const std::string& aov, double x,
                                 double y) {
    const raytrace::Film& film = picture.film;
    auto at = [&](int width, int height) {
        const int column = std::clamp(int(x * width), 0, width - 1);
        return size_t(std::clamp(int(y * height), 0, height - 1)) * size_t(width) + size_t(column);
    };
    if (shows_costs(aov)) {
        if (picture.costs.empty()) return {};
        return {cost_numbers(picture.costs, aov)[at(picture.costs.width, picture.costs.height)]};
    }
    if (shows_guide(aov)) {
        const size_t k = at(picture.width, picture.height);
        const PictureGuide& guide = picture.guide;
        if (k >= guide.surface.size() || guide.surface[k] == kNone) return {};
        if (aov == "depth") return {guide.depth[k]};
        if (aov == "surface") return {float(guide.surface[k])};
        return {guide.Ng[k].x, guide.Ng[k].y, guide.Ng[k].z};
    }
    std::vector<float> numbers;
    if (aov.empty() || film.width <= 0 || film.height <= 0) return numbers;
    for (const raytrace::AovPlane* plane : planes_of(film, aov))
        numbers.push_back(plane->values[at(film.width, film.height)]);
    return numbers;
}

vec3 false_color(float value) {
    if (!(value > 0)) return vec3(0.0f);
    if (value > 1) return vec3(1.0f);
    constexpr vec3 kStops[] = {
        {0, 0, 0.3f}, {0, 0.3f, 1}, {0, 0.8f, 0.2f}, {1, 0.8f, 0}, {1, 0, 0}};
    float at = value * 4;
    size_t k = std::min(size_t(at), size_t(3));
    float share = at - float(k);
    return kStops[k] * (1 - share) + kStops[k + 1] * share;
}

bool is_plain(const DisplaySettings& settings) {
    return settings.aov.empty() && settings.tone == ToneCurve::Plain && !settings.false_color;
}

void show_kept(const DisplaySettings& settings, int width, int height, std::vector<uint8_t>& out) {
    if (settings.kept) put_kept(*settings.kept, settings.wipe_at, width, height, out);
}

void display(const raytrace::Film& film, const PictureGuide& guide, const PixelCosts& costs,
             const DisplaySettings& settings, std::vector<uint8_t>& out) {
    if (is_plain(settings))
        fast_8_bit(film, settings.encoding, out);
    else if (shows_costs(settings.aov))
        fast_8_bit(of_costs(film, costs, settings.aov), ColorEncoding::Srgb, out);
    else if (shows_guide(settings.aov))
        fast_8_bit(of_guide(film, guide, settings), settings.encoding, out);
    else
        fast_8_bit(settings.aov.empty() ? of_picture(film, settings) : of_aov(film, settings),
                   settings.encoding, out);
    show_kept(settings, film.width, film.height, out);
}

}  // namespace kinora
