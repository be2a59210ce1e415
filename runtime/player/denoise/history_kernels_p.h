// runtime/player/denoise/history_kernels_p.h: the kernels of history_kernels.h in plain C++, as
// kernels_p.h has them: the compiler makes vectors of the loops, all widths give the same bits.
#pragma once

#include <limits>
#include <utility>

#include "runtime/player/denoise/brightness_p.h"
#include "runtime/player/denoise/history_kernels.h"

namespace kinora {
namespace {

constexpr size_t kRun = kFilterRun;
using Row = float[kRun];

#define KINORA_LANE __attribute__((always_inline)) inline

KINORA_LANE float larger(float a, float b) {
    return a > b ? a : b;
}
KINORA_LANE float smaller(float a, float b) {
    return a < b ? a : b;
}

constexpr float kSamePlane = 0.05f;  // share of the depth
constexpr float kSameWay = 0.8f;     // cosine between normals
constexpr float kLeastSeen = 0.05f;  // of the four pixels about a place

using FourFloats = float __attribute__((vector_size(16)));

KINORA_LANE FourFloats load_four(const float* from) {
    FourFloats four;
    __builtin_memcpy(&four, from, sizeof(four));
    return four;
}

// One by one: what they find lies anywhere.
void look_back(const PictureBefore& before, const LookBack& rows, const SeenResult& to) {
    for (size_t i = 0; i < kRun; ++i) {
        const float x = rows.x[i], y = rows.y[i], depth = rows.depth[i];
        to.count[i] = 0;
        if (!(x > -1 && y > -1 && x < float(before.width) && y < float(before.height))) continue;
        const int left = int(x + 1) - 1, top = int(y + 1) - 1;
        const float right = x - float(left), below = y - float(top);
        const SeenPixel* pixel = before.pixels + top * before.stride + left;
        FourFloats color{}, moments{};
        float weights = 0;
        for (int k = 0; k < 4; ++k) {
            const int column = k % 2, row = k / 2;
            const SeenPixel& seen = pixel[row * before.stride + column];
            const float expected = seen.depth + seen.slope[0] * (right - float(column)) +
                                   seen.slope[1] * (below - float(row));
            const float facing =
                seen.N[0] * rows.N[0][i] + seen.N[1] * rows.N[1][i] + seen.N[2] * rows.N[2][i];
            const bool is_it =
                seen.surface == rows.surface[i] &&
                __builtin_fabsf(expected - depth) <= kSamePlane * __builtin_fabsf(depth) &&
                facing >= kSameWay;
            if (!is_it) continue;
            const float weight = (column ? right : 1 - right) * (row ? below : 1 - below);
            color += weight * load_four(seen.c);
            moments += weight * load_four(&seen.first);
            weights += weight;
        }
        if (weights < kLeastSeen) continue;
        const float scale = 1 / weights;
        for (int k = 0; k < 4; ++k) to.c[k][i] = color[k] * scale;
        to.first[i] = moments[0] * scale;
        to.second[i] = moments[1] * scale;
        to.count[i] = moments[2] * scale;
    }
}

// What the pixels about one have seen, those of its surface; stays in registers.
struct About {
    float r = 0, g = 0, b = 0, a = 0;  // of the new colors: sums, and of squares
    float r2 = 0, g2 = 0, b2 = 0, a2 = 0;
    float count = 0;
    // How the brightness differs from what was seen before, where anything was.
    float change = 0, changes = 0, known = 0;
};

// Of nine, row by row.
template <int number>
KINORA_LANE void add_near(const BlendRows& rows, ptrdiff_t stride, size_t i, About& about) {
    const ptrdiff_t at = (number / 3 - 1) * stride + number % 3 - 1 + ptrdiff_t(i);
    const bool same = rows.surface[at] == rows.surface[i];
    const float r = rows.fresh[0][at], g = rows.fresh[1][at], b = rows.fresh[2][at],
                a = rows.fresh[3][at];
    const float red = same ? r : 0, green = same ? g : 0, blue = same ? b : 0, alpha = same ? a : 0;
    about.r += red;
    about.g += green;
    about.b += blue;
    about.a += alpha;
    about.r2 += red * red;
    about.g2 += green * green;
    about.b2 += blue * blue;
    about.a2 += alpha * alpha;
    about.count += same ? 1.0f : 0.0f;
    const float count = rows.seen.count[at], seen = same ? count : 0;
    const float differs = brightness(r, g, b) -
                          brightness(rows.seen.c[0][at], rows.seen.c[1][at], rows.seen.c[2][at]);
    const float change = seen >= 1 ? differs : 0;
    about.change += change;
    about.changes += change * change;
    about.known += seen >= 1 ? 1.0f : 0.0f;
}

template <int... number>
KINORA_LANE About look_about(std::integer_sequence<int, number...>, const BlendRows& rows,
                             ptrdiff_t stride, size_t i) {
    About about;
    (add_near<number>(rows, stride, i, about), ...);
    return about;
}

// The share of the new color that makes the error least which a change and the noise leave
// together. A mean change that noise alone may have says nothing.
KINORA_LANE float share_of_change(float sum, float squares, float count) {
    constexpr float kByChance = 2;  // times the variance of a mean
    const float known = larger(count, 1);
    const float mean = sum / known, noise = larger(squares / known - mean * mean, 1e-12f);
    const float change = mean * mean - kByChance * noise / known;
    const float share = change / (change + noise);
    const float sound = change > 0 ? share : 0;
    return count < 3 ? 0 : sound;
}

// A number of before, within one deviation of the mean of `count` new ones.
KINORA_LANE float clipped(float before, float sum, float squares, float count) {
    const float mean = sum / count;
    const float about = __builtin_sqrtf(larger(squares / count - mean * mean, 0));
    return smaller(larger(before, mean - about), mean + about);
}

void blend(const BlendRows& all, ptrdiff_t stride) {
    constexpr float kMostCount = 64;
    const BlendRows rows = all;
#pragma GCC ivdep
    for (size_t i = 0; i < kRun; ++i) {
        const About about = look_about(std::make_integer_sequence<int, 9>(), rows, stride, i);
        const float seen = rows.seen.count[i];
        const bool known = seen >= 1, noisy = rows.variance[i] > 0;
        const float changed = share_of_change(about.change, about.changes, about.known);
        const float pictures = smaller(smaller(seen + 1, kMostCount), 1 / larger(changed, 1e-6f));
        const float newest = larger(1 / pictures, kNewestShare);
        const float share = known ? newest : 1, count = known ? pictures : 1;
        rows.count[i] = noisy ? count : 0;
        const float r = rows.fresh[0][i], g = rows.fresh[1][i], b = rows.fresh[2][i],
                    a = rows.fresh[3][i];
        const float within_r = clipped(rows.seen.c[0][i], about.r, about.r2, about.count),
                    within_g = clipped(rows.seen.c[1][i], about.g, about.g2, about.count),
                    within_b = clipped(rows.seen.c[2][i], about.b, about.b2, about.count),
                    within_a = clipped(rows.seen.c[3][i], about.a, about.a2, about.count);
        const float old_r = known ? within_r : r, old_g = known ? within_g : g,
                    old_b = known ? within_b : b, old_a = known ? within_a : a;
        // Pixels without a variance have the same there.
        rows.c[0][i] = known & noisy ? old_r + share * (r - old_r) : r;
        rows.c[1][i] = known & noisy ? old_g + share * (g - old_g) : g;
        rows.c[2][i] = known & noisy ? old_b + share * (b - old_b) : b;
        rows.c[3][i] = known & noisy ? old_a + share * (a - old_a) : a;
        const float bright = brightness(r, g, b), before = brightness(old_r, old_g, old_b);
        const float seen_first = rows.seen.first[i];
        const float spread = rows.seen.second[i] - seen_first * seen_first;
        const float square = (known ? spread : 0) + before * before;
        rows.first[i] = before + share * (bright - before);
        rows.second[i] = square + share * (bright * bright - square);
    }
}

// Sums over the square of nine pixels that a pixel is a corner of.
struct Square {
    float first = 0, second = 0, count = 0;
};

// Of 25, row by row, to each of the four squares that it is in.
template <int number>
KINORA_LANE void add_corner(const uint32_t* surface, const SeenRows& seen, ptrdiff_t stride,
                            size_t i, Square (&squares)[4]) {
    constexpr int x = number % 5 - 2, y = number / 5 - 2;
    const ptrdiff_t at = y * stride + x + ptrdiff_t(i);
    const bool same = surface[at] == surface[i];
    const float first_there = seen.first[at], second_there = seen.second[at];
    const float first = same ? first_there : 0, second = same ? second_there : 0,
                count = same ? 1.0f : 0.0f;
    const auto add = [&](Square& square) {
        square.first += first;
        square.second += second;
        square.count += count;
    };
    if constexpr (x <= 0 && y <= 0) add(squares[0]);
    if constexpr (x >= 0 && y <= 0) add(squares[1]);
    if constexpr (x <= 0 && y >= 0) add(squares[2]);
    if constexpr (x >= 0 && y >= 0) add(squares[3]);
}

template <int... number>
KINORA_LANE void add_corners(std::integer_sequence<int, number...>, const uint32_t* surface,
                             const SeenRows& seen, ptrdiff_t stride, size_t i,
                             Square (&squares)[4]) {
    (add_corner<number>(surface, seen, stride, i, squares), ...);
}

constexpr float kUnknown = std::numeric_limits<float>::max();

KINORA_LANE float spread_of(const Square& square) {
    const float count = larger(square.count, 1), mean = square.first / count;
    const float spread = larger(square.second / count - mean * mean, 0);
    return count > 3 ? spread : kUnknown;
}

// Variance of the brightness about each pixel: the least of the four squares, since one of them
// does not cross the edge of a shadow.
void find_variance(const uint32_t* surface, const SeenRows& all, ptrdiff_t stride,
                   float* variance) {
    constexpr float kLeastOfFour = 1.6f;  // what the least of four estimates is short of their mean
    const SeenRows seen = all;
#pragma GCC ivdep
    for (size_t i = 0; i < kRun; ++i) {
        Square squares[4];
        add_corners(std::make_integer_sequence<int, 25>(), surface, seen, stride, i, squares);
        const float least = smaller(smaller(spread_of(squares[0]), spread_of(squares[1])),
                                    smaller(spread_of(squares[2]), spread_of(squares[3])));
        const float around = least < kUnknown ? kLeastOfFour * least : 0;
        const float count = seen.count[i], first = seen.first[i];
        const float own = larger(seen.second[i] - first * first, 0);
        const float spread = count >= kFewPictures ? smaller(around, own) : around;
        // Of the mixture: of so many samples of equal share, or of ever smaller ones.
        const float of_mixture = larger(1 / larger(count, 1), kNewestShare / (2 - kNewestShare));
        const float found = larger(spread * of_mixture, 1e-12f);
        variance[i] = variance[i] > 0 ? found : variance[i];
    }
}

#undef KINORA_LANE

}  // namespace

extern const HistoryKernels KINORA_KERNEL_TABLE(History);
const HistoryKernels KINORA_KERNEL_TABLE(History) = {KINORA_INSTRUCTION_SET, look_back, blend,
                                                     find_variance};

}  // namespace kinora
