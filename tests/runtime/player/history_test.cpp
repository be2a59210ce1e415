// tests/runtime/player/history_test.cpp: how what was seen before is mixed with what is new.
#include "runtime/player/denoise/history_kernels.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "runtime/player/denoise/planes.h"

namespace kinora {
namespace {

constexpr int kWidth = 64, kHeight = 24;

// Two surfaces; a part that nothing was seen of before; a column without noise; a bright change.
struct Scenery {
    Planes planes;
    std::vector<float> seen[4], first, second, count;
    Scenery() {
        planes.resize(kWidth, kHeight);
        for (auto* plane : {&seen[0], &seen[1], &seen[2], &seen[3], &first, &second, &count})
            plane->assign(planes.surface.size(), 0.0f);
        uint32_t state = 7;
        const auto number = [&] {
            state = state * 1664525u + 1013904223u;
            return float(state >> 8) / float(1 << 24);
        };
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const size_t at = planes.at(x, y);
                planes.surface[at] = x + y < 40 ? 4 : 9;
                planes.variance[at] = x == 20 ? 0 : 1;
                const float change = y > 16 ? 0.8f : 0;
                for (int k = 0; k < 4; ++k) {
                    seen[k][at] = number();
                    planes.c[k][at] = number() + change;
                }
                if (x == 20 || (x > 48 && y < 8)) continue;
                count[at] = float(1 + (x + y) % 9);
                first[at] = number();
                second[at] = first[at] * first[at] + 0.1f * number();
            }
    }
    SeenRows seen_rows(size_t at) const {
        return {{&seen[0][at], &seen[1][at], &seen[2][at], &seen[3][at]},
                &first[at],
                &second[at],
                &count[at]};
    }
};

double bright(double r, double g, double b) {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

struct Mixed {
    double c[4] = {}, first = 0, second = 0, count = 0;
};

// As the header says it, in double; offsets in the order of columns.
Mixed expected(const Scenery& s, int x, int y) {
    const Planes& p = s.planes;
    const size_t here = p.at(x, y);
    std::vector<size_t> about;
    for (int dx = 1; dx >= -1; --dx)
        for (int dy = 1; dy >= -1; --dy)
            if (const size_t at = p.at(x + dx, y + dy); p.surface[at] == p.surface[here])
                about.push_back(at);
    std::vector<double> changes;
    for (size_t at : about)
        if (s.count[at] >= 1)
            changes.push_back(bright(p.c[0][at], p.c[1][at], p.c[2][at]) -
                              bright(s.seen[0][at], s.seen[1][at], s.seen[2][at]));
    Mixed mixed;
    const double now = bright(p.c[0][here], p.c[1][here], p.c[2][here]);
    for (int k = 0; k < 4; ++k) mixed.c[k] = p.c[k][here];
    mixed.first = now;
    mixed.second = now * now;
    mixed.count = 1;
    if (s.count[here] < 1) return mixed;
    double share = 0;
    if (const auto n = double(changes.size()); n >= 3) {
        double mean = 0, noise = 0;
        for (double c : changes) mean += c / n;
        for (double c : changes) noise += (c - mean) * (c - mean) / n;
        const double change = mean * mean - 2 * noise / n;
        share = change > 0 ? change / (change + noise) : 0;
    }
    mixed.count = std::min({double(s.count[here]) + 1, 64.0, 1 / std::max(share, 1e-6)});
    const double newest = std::max(1 / mixed.count, 0.2);
    double old[4];
    for (int k = 0; k < 4; ++k) {
        double mean = 0, spread = 0;
        for (size_t at : about) mean += p.c[k][at] / double(about.size());
        for (size_t at : about)
            spread += (p.c[k][at] - mean) * (p.c[k][at] - mean) / double(about.size());
        old[k] =
            std::clamp(double(s.seen[k][here]), mean - std::sqrt(spread), mean + std::sqrt(spread));
        mixed.c[k] = old[k] + newest * (p.c[k][here] - old[k]);
    }
    const double before = bright(old[0], old[1], old[2]);
    const double second = s.second[here] - double(s.first[here]) * s.first[here] + before * before;
    mixed.first = before + newest * (now - before);
    mixed.second = second + newest * (now * now - second);
    return mixed;
}

// Of the four squares of nine that (x, y) is a corner of.
double expected_variance(const Scenery& s, const std::vector<Mixed>& all, int x, int y) {
    const Planes& p = s.planes;
    const size_t here = p.at(x, y);
    double least = std::numeric_limits<double>::infinity();
    for (int right : {-1, 1})
        for (int below : {-1, 1}) {
            double first = 0, second = 0, count = 0;
            for (int k = 0; k < 9; ++k) {
                const size_t at = p.at(x + right * (k % 3), y + below * (k / 3));
                if (p.surface[at] != p.surface[here]) continue;
                first += all[at].first;
                second += all[at].second;
                ++count;
            }
            if (count > 3)
                least =
                    std::min(least, std::max(second / count - first * first / count / count, 0.0));
        }
    double spread = std::isfinite(least) ? 1.6 * least : 0;
    const Mixed& own = all[here];
    if (own.count >= 4)
        spread = std::min(spread, std::max(own.second - own.first * own.first, 0.0));
    return std::max(spread * std::max(1 / own.count, 1.0 / 9), 1e-12);
}

TEST(History, EveryKernelGivesTheSameBitsAndWhatTheMixtureMeans) {
    const Scenery s;
    std::vector<Mixed> all(s.planes.surface.size());
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (s.planes.variance[s.planes.at(x, y)] > 0)
                all[s.planes.at(x, y)] = expected(s, x, y);
    std::vector<float> of_first_kernel;
    for (size_t number = 0; number < usable_history_kernels().count; ++number) {
        const HistoryKernels& kernels = *usable_history_kernels().kernels[number];
        Planes mixed = s.planes;
        std::vector<float> first(all.size()), second(all.size()), count(all.size());
        const auto moments = [&](size_t at) {
            return SeenRows{{}, &first[at], &second[at], &count[at]};
        };
        for (int y = 0; y < kHeight; ++y) {
            const size_t at = s.planes.at(0, y);
            const Planes& p = s.planes;
            kernels.blend({&p.surface[at],
                           &p.variance[at],
                           {&p.c[0][at], &p.c[1][at], &p.c[2][at], &p.c[3][at]},
                           s.seen_rows(at),
                           {&mixed.c[0][at], &mixed.c[1][at], &mixed.c[2][at], &mixed.c[3][at]},
                           &first[at],
                           &second[at],
                           &count[at]},
                          p.stride);
        }
        int changed = 0, unseen = 0;
        for (int y = 0; y < kHeight; ++y) {
            kernels.find_variance(&s.planes.surface[s.planes.at(0, y)], moments(s.planes.at(0, y)),
                                  s.planes.stride, &mixed.variance[s.planes.at(0, y)]);
            for (int x = 0; x < kWidth; ++x) {
                const size_t at = s.planes.at(x, y);
                for (int k = 0; k < 4 && x == 20; ++k) EXPECT_EQ(mixed.c[k][at], s.planes.c[k][at]);
                EXPECT_EQ(mixed.variance[at] == 0, x == 20);
                if (x == 20) continue;
                for (int k = 0; k < 4; ++k)
                    ASSERT_NEAR(mixed.c[k][at], all[at].c[k], 1e-5)
                        << kernels.name << ' ' << x << ' ' << y;
                ASSERT_NEAR(first[at], all[at].first, 1e-5);
                ASSERT_NEAR(second[at], all[at].second, 1e-5);
                ASSERT_NEAR(count[at], all[at].count, 1e-3 * all[at].count);
                // Next to the column without noise, whose own moments are nobody's.
                if (std::abs(x - 20) > 2) {
                    ASSERT_NEAR(mixed.variance[at], expected_variance(s, all, x, y), 1e-5)
                        << kernels.name << ' ' << x << ' ' << y;
                }
                changed += all[at].count < double(s.count[at]);
                unseen += s.count[at] < 1;
            }
        }
        EXPECT_GT(changed, 100);
        EXPECT_GT(unseen, 100);
        std::vector<float> bits;
        for (const auto* plane : {&mixed.c[0], &mixed.c[1], &mixed.c[2], &mixed.c[3],
                                  &mixed.variance, &first, &second, &count})
            bits.insert(bits.end(), plane->begin(), plane->end());
        if (number == 0) of_first_kernel = bits;
        EXPECT_EQ(0, std::memcmp(bits.data(), of_first_kernel.data(), bits.size() * sizeof(float)))
            << kernels.name;
    }
}

// Places between the pixels of a picture before, on it and beside it; as the header says it.
TEST(History, LooksBackBetweenPixelsOfTheSameSurface) {
    const Scenery s;
    Planes before = s.planes;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const size_t at = before.at(x, y);
            const bool left = x < 30;
            before.N[0][at] = left ? 0.6f : -0.6f;
            before.N[2][at] = 0.8f;
            before.slope[0][at] = 0.01f;
            before.depth[at] = 1 + 0.01f * float(x) + (y > 12 ? 0.5f : 0);
        }
    std::vector<SeenPixel> pixels(before.surface.size());
    for (size_t at = 0; at < pixels.size(); ++at)
        pixels[at] = {{s.seen[0][at], s.seen[1][at], s.seen[2][at], s.seen[3][at]},
                      s.first[at],
                      s.second[at],
                      s.count[at],
                      before.depth[at],
                      {before.N[0][at], before.N[1][at], before.N[2][at]},
                      {before.slope[0][at], before.slope[1][at]},
                      before.surface[at]};
    std::vector<float> of_first_kernel;
    for (size_t number = 0; number < usable_history_kernels().count; ++number) {
        std::vector<float> bits;
        int found = 0, lost = 0;
        for (int y = -2; y < kHeight + 2; ++y) {
            float px[kFilterRun], py[kFilterRun], depth[kFilterRun], N[3][kFilterRun] = {};
            uint32_t surface[kFilterRun];
            for (int i = 0; i < kWidth; ++i) {
                px[i] = 1.07f * float(i) - 2.3f;
                py[i] = float(y) + 0.01f * float(i);
                depth[i] = 1 + 0.01f * px[i];
                surface[i] = i % 3 ? 9 : 4;
                N[0][i] = i < 40 ? 0.6f : -0.6f;
                N[2][i] = 0.8f;
            }
            float c[4][kFilterRun], first[kFilterRun], second[kFilterRun], count[kFilterRun];
            usable_history_kernels().kernels[number]->look_back(
                {kWidth, kHeight, before.stride, &pixels[before.at(0, 0)]},
                {px, py, depth, surface, {N[0], N[1], N[2]}},
                {{c[0], c[1], c[2], c[3]}, first, second, count});
            for (int i = 0; i < kWidth; ++i) {
                double sum = 0, pictures = 0, weights = 0;
                const int left = int(std::floor(px[i])), top = int(std::floor(py[i]));
                const bool inside = px[i] > -1 && py[i] > -1 && px[i] < kWidth && py[i] < kHeight;
                for (int k = 0; k < 4 && inside; ++k) {
                    const int column = left + k % 2, row = top + k / 2;
                    const size_t at = before.at(column, row);
                    const double right = double(px[i]) - column, below = double(py[i]) - row;
                    const double deep = before.depth[at] + before.slope[0][at] * right;
                    double facing = 0;
                    for (int n = 0; n < 3; ++n) facing += double(before.N[n][at]) * N[n][i];
                    if (before.surface[at] != surface[i] || facing < 0.8 ||
                        std::abs(deep - depth[i]) > 0.05 * depth[i])
                        continue;
                    const double weight = (1 - std::abs(right)) * (1 - std::abs(below));
                    sum += weight * s.seen[1][at];
                    pictures += weight * s.count[at];
                    weights += weight;
                }
                if (weights < 0.049 || pictures == 0) {
                    ASSERT_EQ(count[i], 0) << i << ' ' << y;
                    ++lost;
                    continue;
                }
                if (weights < 0.051) continue;
                ASSERT_NEAR(count[i], pictures / weights, 1e-4) << i << ' ' << y;
                ASSERT_NEAR(c[1][i], sum / weights, 1e-4);
                ++found;
                bits.insert(bits.end(),
                            {c[0][i], c[1][i], c[2][i], c[3][i], first[i], second[i], count[i]});
            }
        }
        EXPECT_GT(found, 100);
        EXPECT_GT(lost, 100);
        if (number == 0) of_first_kernel = bits;
        ASSERT_EQ(bits.size(), of_first_kernel.size());
        EXPECT_EQ(0, std::memcmp(bits.data(), of_first_kernel.data(), bits.size() * sizeof(float)));
    }
}

}  // namespace
}  // namespace kinora
