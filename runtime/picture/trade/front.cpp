// runtime/picture/trade/front.cpp: the Pareto front; order statistics.
#include "runtime/picture/trade/front.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

// Of `count` throws of a coin at most `k` heads.
double binomial_tail(size_t count, size_t k) {
    double term = std::pow(0.5, double(count)), sum = 0;
    for (size_t i = 0; i <= k; ++i) {
        sum += term;
        term *= double(count - i) / double(i + 1);
    }
    return sum;
}

}  // namespace

std::vector<bool> pareto_front(std::span<const TradePoint> points, double floor) {
    std::vector<bool> front(points.size(), true);
    auto error = [&](size_t i) { return std::max(points[i].error, floor); };
    for (size_t i = 0; i < points.size(); ++i)
        for (size_t j = 0; j < points.size(); ++j) {
            bool not_worse = points[j].ms <= points[i].ms && error(j) <= error(i);
            bool better = points[j].ms < points[i].ms || error(j) < error(i);
            if (not_worse && better) front[i] = false;
        }
    return front;
}

double off_front(const TradePoint& point, std::span<const TradePoint> points, double floor) {
    double fastest = point.ms;
    for (const TradePoint& p : points)
        if (std::max(p.error, floor) <= std::max(point.error, floor))
            fastest = std::min(fastest, p.ms);
    return fastest > 0 ? point.ms / fastest - 1 : 0;
}

MedianInterval median_interval(std::vector<double> values) {
    const size_t n = values.size();
    if (n == 0) return {};
    std::ranges::sort(values);
    MedianInterval result;
    result.median = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
    // The interval from value k to value n - 1 - k misses where at most k lie on one side.
    size_t k = 0;
    while (k + 1 < (n + 1) / 2 && 1 - 2 * binomial_tail(n, k + 1) >= 0.95) ++k;
    result.low = values[k];
    result.high = values[n - 1 - k];
    result.cover = std::max(0.0, 1 - 2 * binomial_tail(n, k));
    return result;
}

}  // namespace kinora
