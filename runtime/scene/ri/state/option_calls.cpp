// runtime/scene/ri/state/option_calls.cpp: options of the camera and the picture.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/transform_matrix.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/context.h"
#include "runtime/scene/ri/state/option_calls.h"

namespace kinora::ri {
namespace {

double real(const Call& call, size_t at) {
    return double(call.arguments[at].real());
}

bool all_finite(const Call& call) {
    return std::ranges::all_of(call.arguments, [](const Values& values) {
        return std::ranges::all_of(values.floats(), [](float x) { return std::isfinite(x); });
    });
}

// Filters that the ray tracer has itself.
constexpr std::string_view kSeparable[] = {"box", "triangle", "gaussian"};

// The function at the middles of cells, called here and now: it may be the program's own.
std::vector<float> filter_cells(RtFilterFunc function, double width, double height) {
    constexpr int kCells = 64;
    std::vector<float> values;
    for (int row = 0; row < kCells; ++row)
        for (int column = 0; column < kCells; ++column)
            values.push_back(function(float(((column + 0.5) / kCells - 0.5) * width),
                                      float(((row + 0.5) / kCells - 0.5) * height), float(width),
                                      float(height)));
    return values;
}

bool is_filter(const std::vector<float>& values) {
    double sum = 0, size = 0;
    for (float value : values) sum += double(value), size += std::abs(double(value));
    return std::isfinite(size) && sum > 1e-3 * size;
}

}  // namespace

bool OptionCalls::call(const Call& call) {
    using R = Request;
    using C = OptionCalls;
    static const Handlers<C> kHandlers = {
        {R::Format, &C::format},
        {R::FrameAspectRatio, &C::frame_aspect_ratio},
        {R::ScreenWindow, &C::screen_window},
        {R::CropWindow, &C::crop_window},
        {R::Projection, &C::projection},
        {R::Clipping, &C::clipping},
        {R::ClippingPlane, &C::clipping_plane},
        {R::DepthOfField, &C::depth_of_field},
        {R::Shutter, &C::shutter},
        {R::PixelSamples, &C::pixel_samples},
        {R::PixelFilter, &C::pixel_filter},
        {R::Exposure, &C::exposure},
        {R::Imager, &C::imager},
        {R::Quantize, &C::quantize},
        {R::Display, &C::display},
        {R::Hider, &C::hider},
        {R::ColorSamples, &C::color_samples},
        {R::RelativeDetail, &C::relative_detail},
        {R::Option, &C::option},
    };
    return kHandlers.call(*this, call);
}

void OptionCalls::format(const Call& call) {
    constexpr int kLargest = 65536;
    int width = call.arguments[0].integer(), height = call.arguments[1].integer();
    if (width > kLargest || height > kLargest)
        return report_.add(Code::RI_RANGE, "Format", "a side is longer than 65536 pixels");
    if (width > 0) state_.options.width = width;
    if (height > 0) state_.options.height = height;
    double aspect = real(call, 2);
    if (aspect > 0 && std::isfinite(aspect)) state_.options.pixel_aspect = aspect;
}

void OptionCalls::frame_aspect_ratio(const Call& call) {
    double aspect = real(call, 0);
    if (!(aspect > 0) || !std::isfinite(aspect))
        return report_.add(Code::RI_RANGE, "FrameAspectRatio", "it must be above 0");
    state_.options.frame_aspect = aspect;
}

void OptionCalls::screen_window(const Call& call) {
    if (!all_finite(call) || real(call, 0) == real(call, 1) || real(call, 2) == real(call, 3))
        return report_.add(Code::RI_RANGE, "ScreenWindow", "it has no area");
    state_.options.screen_window = {real(call, 0), real(call, 1), real(call, 2), real(call, 3)};
}

void OptionCalls::crop_window(const Call& call) {
    std::array<double, 4> crop = {real(call, 0), real(call, 1), real(call, 2), real(call, 3)};
    if (!all_finite(call) || crop[0] >= crop[1] || crop[2] >= crop[3])
        return report_.add(Code::RI_RANGE, "CropWindow", "it has no area");
    state_.options.crop = crop;
}

void OptionCalls::projection(const Call& call) {
    Projection made;
    made.perspective = call.arguments[0].string() == "perspective";
    if (const Parameter* fov = call.find("fov")) made.fov = double(fov->values.real());
    if (made.perspective && !(made.fov > 0 && made.fov < 180)) {
        report_.add(Code::RI_RANGE, "Projection", "fov lies not between 0 and 180 degrees");
        made.fov = 90;
    }
    if (is_singular(state_.transform))
        report_.add(Code::RI_RANGE, "Projection", "the transformation before it makes all flat");
    else
        made.from_camera = state_.transform;
    state_.options.projection = made;
    state_.transform = dmat4(1.0);
}

void OptionCalls::clipping(const Call& call) {
    double near = real(call, 0), far = real(call, 1);
    if (!(near < far))
        return report_.add(Code::RI_RANGE, "Clipping", "the far plane is not behind the near one");
    state_.options.near = std::max(near, 1e-10);
    state_.options.far = far;
}

void OptionCalls::clipping_plane(const Call& call) {
    const dmat4& m = state_.transform;
    const dvec3 at(m * dvec4(real(call, 0), real(call, 1), real(call, 2), 1));
    const dvec3 normal(real(call, 3), real(call, 4), real(call, 5));
    const dvec3 n = glm::transpose(glm::inverse(dmat3(m))) * normal;
    const double length = glm::length(n);
    if (!all_finite(call) || !(length > 0) || !std::isfinite(length))
        return report_.add(Code::RI_RANGE, "ClippingPlane", "it has no normal");
    if (state_.options.planes.size() == kMostClippingPlanes)
        return report_.add(Code::RI_RANGE, "ClippingPlane",
                           fmt::format("at most {} planes cut", kMostClippingPlanes));
    state_.options.planes.emplace_back(n / length, -glm::dot(n, at) / length);
}

void OptionCalls::depth_of_field(const Call& call) {
    if (call.arguments[0].real() < 1e37f) report_.not_done("DepthOfField", "all is sharp");
}

void OptionCalls::shutter(const Call& call) {
    if (!all_finite(call)) return report_.add(Code::RI_RANGE, "Shutter", "a time is not finite");
    state_.options.shutter_open = real(call, 0);
    state_.options.shutter_close = real(call, 1);
}

void OptionCalls::pixel_samples(const Call& call) {
    double x = real(call, 0), y = real(call, 1);
    if (!(x >= 1 && y >= 1 && x * y <= 65536))
        return report_.add(Code::RI_RANGE, "PixelSamples", "both are from 1 to 256");
    state_.options.samples = {x, y};
}

void OptionCalls::pixel_filter(const Call& call) {
    double width = real(call, 1), height = real(call, 2);
    if (!(width > 0 && height > 0 && width <= 64 && height <= 64))
        return report_.add(Code::RI_RANGE, "PixelFilter", "a width is not above 0");
    const std::string name(call.arguments[0].string());
    auto own = reinterpret_cast<RtFilterFunc>(call.arguments[0].function());
    if (!own && name.empty())
        return report_.add(Code::RI_RANGE, "PixelFilter", "there is no filter function");
    const bool is_ours = std::ranges::count(kSeparable, name) > 0 && width == height;
    const RtFilterFunc function = own ? own : is_ours ? nullptr : filter_function(name);
    std::vector<float> values;
    if (function) {
        values = filter_cells(function, width, height);
        if (!is_filter(values))
            return report_.add(Code::RI_RANGE, "PixelFilter", "its values have no sum above 0");
    }
    state_.options.filter = name;
    state_.options.filter_width = width;
    state_.options.filter_height = height;
    state_.options.filter_values = std::move(values);
}

void OptionCalls::exposure(const Call& call) {
    double gain = real(call, 0), gamma = real(call, 1);
    if (!all_finite(call) || !(gain >= 0) || !(gamma > 0))
        return report_.add(Code::RI_RANGE, "Exposure", "gain and gamma must be above 0");
    state_.options.exposure = {gain, gamma};
}

void OptionCalls::imager(const Call& call) {
    Binding made = shaders_.bind(call, 0, "imager");
    state_.options.imagers.clear();
    if (made) state_.options.imagers.push_back(std::move(made));
}

void OptionCalls::quantize(const Call& call) {
    const double one = call.arguments[1].integer();
    const double low = call.arguments[2].integer(), high = call.arguments[3].integer();
    if (low > high) return report_.add(Code::RI_RANGE, "Quantize", "min is above max");
    std::string type(call.arguments[0].string());
    if (type == "rgb") type = "rgba";
    state_.options.quantizations[type] = {one, low, high};
}

// A name with + goes beside the displays before it; one without replaces them.
void OptionCalls::display(const Call& call) {
    FileDisplay made;
    std::string_view name = call.arguments[0].string();
    const bool added = name.starts_with('+');
    made.name = std::string(added ? name.substr(1) : name);
    made.type = std::string(call.arguments[1].string());
    made.mode = std::string(call.arguments[2].string());
    made.where = call.where;
    if (const Parameter* own = call.find("quantize")) {
        auto numbers = own->values.floats();
        if (numbers.size() == 4 && numbers[2] <= numbers[3])
            made.quantization = {double(numbers[1]), double(numbers[2]), double(numbers[3]),
                                 double(numbers[0])};
        else
            report_.add(Code::RI_RANGE, "Display",
                        "\"quantize\" is what 0 and 1 become, the least and the largest");
    }
    if (const Parameter* own = call.find("exposure")) {
        auto numbers = own->values.floats();
        if (numbers.size() == 2 && numbers[0] > 0 && numbers[1] > 0)
            made.exposure = {double(numbers[0]), double(numbers[1])};
        else
            report_.add(Code::RI_RANGE, "Display", "\"exposure\" is a gain and a gamma above 0");
    }
    if (!added) state_.options.displays.clear();
    state_.options.displays.push_back(std::move(made));
}

void OptionCalls::hider(const Call& call) {
    const std::string_view name = call.arguments[0].string();
    if (name == "paint") report_.not_done("Hider \"paint\"", "what is nearer hides what is behind");
    if (name == "null") report_.not_done("Hider \"null\"", "the picture is made");
}

void OptionCalls::color_samples(const Call& call) {
    auto to_rgb = call.arguments[0].floats();
    if (to_rgb.empty() || to_rgb.size() % 3)
        return report_.add(Code::RI_COUNTS, "ColorSamples", "its numbers are no triples");
    state_.options.to_rgb.assign(to_rgb.begin(), to_rgb.end());
}

void OptionCalls::relative_detail(const Call& call) {
    if (real(call, 0) >= 0) state_.options.relative_detail = real(call, 0);
}

// "a:&:b": & is what it was, @ the folders that we search anyway.
void OptionCalls::option(const Call& call) {
    keep_told(state_.options.told, call);
    if (call.arguments[0].string() != "searchpath") return;
    for (const Parameter& parameter : call.parameters) {
        std::vector<std::string> before = state_.options.search_paths[std::string(parameter.name)],
                                 after;
        for (const char* text : parameter.values.strings()) {
            std::string_view rest = text;
            while (!rest.empty()) {
                // A colon behind one letter belongs to a drive's name.
                size_t end = rest.find(':');
                if (end == 1 && std::isalpha(static_cast<unsigned char>(rest[0])) &&
                    rest.size() > 2 && (rest[2] == '/' || rest[2] == '\\'))
                    end = rest.find(':', 2);
                std::string folder(rest.substr(0, end));
                rest = end == rest.npos ? "" : rest.substr(end + 1);
                if (folder == "&")
                    after.insert(after.end(), before.begin(), before.end());
                else if (!folder.empty() && folder != "@")
                    after.push_back(std::move(folder));
            }
        }
        state_.options.search_paths[std::string(parameter.name)] = std::move(after);
    }
}

}  // namespace kinora::ri
