// runtime/programs/tradeoff/plot.h: error against time as an SVG picture.
#pragma once

#include <string>
#include <vector>

namespace kinora {

struct PlotPoint {
    double x = 0, y = 0;
    std::string label{};   // shown where `named`, and when the pointer is on it
    std::string series{};  // points of one series have one colour
    bool named = false, on_front = false;
};

struct Plot {
    std::string title{}, x_title{}, y_title{};
    std::vector<PlotPoint> points{};
    double floor = 0;  // of y: a line; less is drawn on it
};

// Logarithmic axes. "" where no point has x and a y or a floor above 0.
std::string plot_svg(const Plot& plot);

// A text inside HTML.
std::string html_text(const std::string& text);

}  // namespace kinora
