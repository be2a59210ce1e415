// runtime/scene/ri/bytestream/consistency.cpp: lengths of arrays that C functions are not told.
#include "runtime/scene/ri/bytestream/consistency_p.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace kinora::ri {
namespace {

using Arguments = std::span<const Values>;

// Of counts none of which should be negative; negative where one is.
int64_t sum(std::span<const int> counts) {
    int64_t total = 0;
    for (int count : counts) {
        if (count < 0) return -1;
        total += count;
    }
    return total;
}

std::string too_few(std::string_view what, int64_t wanted, const Values& values) {
    if (wanted < 0) return fmt::format("a number of {} is negative", what);
    if (uint64_t(wanted) <= values.size()) return "";
    return fmt::format("{} {} are wanted, and {} are here", wanted, what, values.size());
}

std::string first_of(std::initializer_list<std::string> reasons) {
    for (const std::string& reason : reasons)
        if (!reason.empty()) return reason;
    return "";
}

// Of each tag how many integers and how many floats it has.
std::string subdivision(Arguments arguments) {
    if (arguments.size() < 7) return "";
    std::span<const int> counts = arguments[4].integers();
    int64_t tags = int64_t(arguments[3].size()), integers = 0, floats = 0;
    std::string few = too_few("counts of the tags' arguments", 2 * tags, arguments[4]);
    if (!few.empty()) return few;
    for (size_t i = 0; i < 2 * size_t(tags); ++i) {
        if (counts[i] < 0) return "a tag has a negative number of arguments";
        (i % 2 ? floats : integers) += counts[i];
    }
    return first_of({too_few("integers of tags", integers, arguments[5]),
                     too_few("floats of tags", floats, arguments[6])});
}

std::string nurbs(Arguments arguments) {
    auto knots = [&](size_t at) {
        return int64_t(arguments[at].integer()) + arguments[at + 1].integer();
    };
    return first_of({too_few("knots along u", knots(0), arguments[2]),
                     too_few("knots along v", knots(5), arguments[7])});
}

std::string trim(Arguments arguments) {
    int64_t curves = sum(arguments[0].integers());
    auto each = [&](std::string_view what, size_t at) {
        return too_few(what, curves, arguments[at]);
    };
    std::string few = first_of(
        {each("orders", 1), each("minima", 3), each("maxima", 4), each("numbers of points", 5)});
    if (!few.empty()) return few;
    int64_t orders = sum(arguments[1].integers().first(size_t(curves)));
    int64_t points = sum(arguments[5].integers().first(size_t(curves)));
    int64_t knots = orders < 0 || points < 0 ? -1 : orders + points;
    return first_of({too_few("knots", knots, arguments[2]), too_few("u", points, arguments[6]),
                     too_few("v", points, arguments[7]), too_few("w", points, arguments[8])});
}

std::string color_samples(Arguments arguments) {
    size_t to = arguments[0].size(), from = arguments[1].size();
    if (to == from && to > 0 && to % 3 == 0) return "";
    return fmt::format("two matrices of 3 numbers a sample are wanted, and {} and {} are here", to,
                       from);
}

std::string procedural(Arguments arguments) {
    int64_t wanted = arguments[0].string() == "DelayedReadArchive" ? 1 : 2;
    return too_few("strings", wanted, arguments[1]);
}

struct CheckRow {
    Request request;
    std::string (*check)(Arguments);
};
constexpr CheckRow kChecks[] = {
    {Request::SubdivisionMesh, subdivision},
    {Request::NuPatch, nurbs},
    {Request::TrimCurve, trim},
    {Request::ColorSamples, color_samples},
    {Request::Procedural, procedural},
};

}  // namespace

std::string contradiction(Request request, Arguments arguments) {
    auto row = std::ranges::find(kChecks, request, &CheckRow::request);
    return row == std::end(kChecks) ? "" : row->check(arguments);
}

}  // namespace kinora::ri
