// runtime/programs/tradeoff/plot.cpp: axes by decades, points by series, the front as a line.
#include "runtime/programs/tradeoff/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

constexpr double kWide = 760, kHigh = 420, kLeft = 70, kRight = 20, kTop = 20, kBottom = 50;

struct LogAxis {
    double low = 0, high = 1;  // decimal logarithms
    double begin = 0, end = 1;

    LogAxis(double least, double most, double from, double to) : begin(from), end(to) {
        low = std::log10(least) - 0.05;
        high = std::log10(most) + 0.05;
        double middle = 0.5 * (low + high);
        low = std::min(low, middle - 0.2);
        high = std::max(high, middle + 0.2);
    }
    double at(double value) const {
        return begin + (std::log10(value) - low) / (high - low) * (end - begin);
    }
    std::vector<double> ticks() const {
        std::vector<double> values;
        const bool many = high - low > 3.5;
        for (int decade = int(std::floor(low)); decade <= int(std::ceil(high)); ++decade)
            for (double step : {1.0, 2.0, 5.0}) {
                double value = step * std::pow(10, decade);
                bool inside = std::log10(value) >= low && std::log10(value) <= high;
                if (inside && (step == 1 || !many)) values.push_back(value);
            }
        return values;
    }
};

std::string axes_svg(const LogAxis& x, const LogAxis& y, const Plot& plot) {
    std::string svg;
    for (double value : x.ticks())
        svg += fmt::format(
            "<path class=grid d=\"M{0:.1f} {1}V{2}\"/><text class=tick x=\"{0:.1f}\" y=\"{3}\" "
            "text-anchor=middle>{4:g}</text>",
            x.at(value), kTop, kHigh - kBottom, kHigh - kBottom + 16, value);
    for (double value : y.ticks())
        svg += fmt::format(
            "<path class=grid d=\"M{1} {0:.1f}H{2}\"/><text class=tick x=\"{3}\" y=\"{4:.1f}\" "
            "text-anchor=end>{5:g}</text>",
            y.at(value), kLeft, kWide - kRight, kLeft - 6, y.at(value) + 4, value);
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=middle>{}</text>",
                       0.5 * (kLeft + kWide - kRight), kHigh - 8, html_text(plot.x_title));
    svg +=
        fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=middle>{}</text>",
                    0.5 * (kTop + kHigh - kBottom), html_text(plot.y_title));
    return svg;
}

// Series in the order in which they come, each with a hue of its own.
std::vector<std::string> series_of(const Plot& plot) {
    std::vector<std::string> series;
    for (const PlotPoint& point : plot.points)
        if (std::ranges::find(series, point.series) == series.end()) series.push_back(point.series);
    return series;
}

std::string front_svg(const Plot& plot, const LogAxis& x, const LogAxis& y, double least) {
    std::vector<const PlotPoint*> front;
    for (const PlotPoint& point : plot.points)
        if (point.on_front) front.push_back(&point);
    std::ranges::sort(front, [](auto* a, auto* b) { return a->x < b->x; });
    std::string line;
    for (const PlotPoint* point : front)
        line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x.at(point->x),
                            y.at(std::max(point->y, least)));
    return front.size() > 1 ? fmt::format("<path class=front d=\"{}\"/>", line) : "";
}

// A name beside its point, above those that stand there already.
class Labels {
  public:
    std::string svg(double x, double y, const std::string& text) {
        const bool right = x > 0.8 * kWide;  // the text would leave the picture
        const double width = kLetter * double(text.size());
        Box box{right ? x - 8 - width : x + 8, y - 6, width};
        while (std::ranges::any_of(placed_, [&](const Box& other) { return meet(box, other); }))
            box.y -= kLine;
        placed_.push_back(box);
        return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor={}>{}</text>",
                           right ? x - 8 : x + 8, box.y, right ? "end" : "start", html_text(text));
    }

  private:
    static constexpr double kLetter = 7, kLine = 14;
    struct Box {
        double left, y, width;
    };
    static bool meet(const Box& a, const Box& b) {
        return a.left < b.left + b.width && b.left < a.left + a.width &&
               std::abs(a.y - b.y) < kLine;
    }
    std::vector<Box> placed_;
};

}  // namespace

std::string html_text(const std::string& text) {
    std::string out;
    for (char c : text) switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    return out;
}

std::string plot_svg(const Plot& plot) {
    double least = plot.floor, most = plot.floor, fast = 0, slow = 0;
    for (const PlotPoint& point : plot.points) {
        if (!(point.x > 0)) continue;
        fast = fast > 0 ? std::min(fast, point.x) : point.x;
        slow = std::max(slow, point.x);
        most = std::max(most, point.y);
        if (plot.floor <= 0 && point.y > 0) least = least > 0 ? std::min(least, point.y) : point.y;
    }
    if (!(fast > 0) || !(most > 0)) return "";
    LogAxis x(fast, slow, kLeft, kWide - kRight), y(least, most, kHigh - kBottom, kTop);
    std::string svg = fmt::format(
        "<figure><figcaption>{}</figcaption><svg class=plot viewBox=\"0 0 {} {}\" role=img>{}",
        html_text(plot.title), kWide, kHigh, axes_svg(x, y, plot));
    if (plot.floor > 0)
        svg += fmt::format(
            "<path class=floor d=\"M{1} {0:.1f}H{2}\"/><text class=tick x=\"{1}\" y=\"{3:.1f}\">"
            "noise floor</text>",  // at the left, where slow points' names do not come
            y.at(plot.floor), kLeft, kWide - kRight, y.at(plot.floor) - 4);
    svg += front_svg(plot, x, y, least);
    const std::vector<std::string> series = series_of(plot);
    Labels labels;
    for (const PlotPoint& point : plot.points) {
        if (!(point.x > 0)) continue;
        size_t s = size_t(std::ranges::find(series, point.series) - series.begin());
        double px = x.at(point.x), py = y.at(std::max(point.y, least));
        svg += fmt::format(
            "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"hsl({} 65% 45%)\">"
            "<title>{}: {:.4g} ms, {:.4g}</title></circle>",
            point.on_front ? "point best" : "point", px, py, point.named ? 6 : 4,
            s * 360 / std::max<size_t>(series.size(), 1), html_text(point.label), point.x, point.y);
        if (!point.named) continue;
        svg += labels.svg(px, py, point.label);
    }
    return svg + "</svg></figure>\n";
}

}  // namespace kinora
