// runtime/picture/trade/front.h: which settings are worth their time, and how sure a median is.
#pragma once

#include <span>
#include <vector>

namespace kinora {

// Errors at or under `floor` are equal: what was measured cannot tell them apart.
struct TradePoint {
    double ms = 0, error = 0;
};

// Whether no other point is faster without a larger error, or as fast with a smaller one.
std::vector<bool> pareto_front(std::span<const TradePoint> points, double floor);

// How much longer a point takes than the fastest whose error is not larger: 0.07 is 7 %.
double off_front(const TradePoint& point, std::span<const TradePoint> points, double floor);

// The median and the interval that holds the true one with a probability of `cover`: two order
// statistics, chosen by the binomial distribution so that `cover` is at least 0.95. Under six
// values none are far enough apart; then it is the whole range, and `cover` says what that holds.
struct MedianInterval {
    double median = 0, low = 0, high = 0, cover = 0;
};
MedianInterval median_interval(std::vector<double> values);

}  // namespace kinora
