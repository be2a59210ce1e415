// runtime/programs/play/raster/triangle.cpp: one triangle to spans, with exact edges.
#include "runtime/programs/play/raster/triangle_p.h"

#include <algorithm>
#include <utility>

namespace kinora::play {

namespace {

// The first pixel at or right of an edge, row by row: x = ceil(numerator / denominator) exactly.
// Coordinates are below 2^30 (raster.cpp clamps them), so that the products fit.
class Edge {
  public:
    // From the upper corner to the lower one, starting in this row.
    Edge(const Corner& top, const Corner& bottom, int row) {
        const int64_t height = int64_t{bottom.y} - top.y, slope = int64_t{bottom.x} - top.x;
        const int64_t down = int64_t{row} * kSubpixels + kSubpixels / 2 - top.y;
        denominator_ = height * kSubpixels;
        set(down * slope + (int64_t{top.x} - kSubpixels / 2) * height);
        const int64_t step = slope * kSubpixels;
        step_ = floor_of(step);
        step_rest_ = step - step_ * denominator_;
    }

    int64_t x() const { return x_; }

    void next_row() {
        x_ += step_;
        rest_ += step_rest_;
        if (rest_ > 0) {
            ++x_;
            rest_ -= denominator_;
        }
    }

  private:
    int64_t floor_of(int64_t value) const {
        int64_t quotient = value / denominator_;
        return quotient * denominator_ > value ? quotient - 1 : quotient;
    }
    // Keeps x_ = ceil(value / denominator) and rest_ = value - x_ * denominator in (-denominator,
    // 0].
    void set(int64_t value) {
        x_ = -((-value) / denominator_);
        if (x_ * denominator_ < value) ++x_;
        rest_ = value - x_ * denominator_;
    }

    int64_t denominator_, x_ = 0, rest_ = 0, step_ = 0, step_rest_ = 0;
};

// A value that is linear over the triangle: at(x, y) in pixels.
struct Plane {
    double value, dx, dy;
};

class Painter {
  public:
    Painter(const DrawState& state, const Corner& a, const Corner& b, const Corner& c)
        : state_(state), a_(a) {
        flat_ = a.rgba == b.rgba && a.rgba == c.rgba;
        const double abx = to_pixels(b.x - a.x), aby = to_pixels(b.y - a.y);
        const double acx = to_pixels(c.x - a.x), acy = to_pixels(c.y - a.y);
        const double area = abx * acy - acx * aby;
        const auto plane = [&](double va, double vb, double vc) {
            const double ab = vb - va, ac = vc - va;
            return Plane{va, (ab * acy - ac * aby) / area, (ac * abx - ab * acx) / area};
        };
        for (int i = 0; i < 4; ++i) colors_[i] = plane(channel(a, i), channel(b, i), channel(c, i));
        u_ = plane(a.u, b.u, c.u);
        v_ = plane(a.v, b.v, c.v);
    }

    void span(int y, int x, int count) const {
        uint32_t* pixels = state_.target.pixels +
                           static_cast<size_t>(y) * static_cast<size_t>(state_.target.stride) + x;
        if (!state_.texture.texels && flat_) {
            state_.kernel.solid(pixels, count, a_.rgba);
            return;
        }
        const double right = x + 0.5 - to_pixels(a_.x), down = y + 0.5 - to_pixels(a_.y);
        const auto at = [&](const Plane& p) {
            return static_cast<float>(p.value + p.dx * right + p.dy * down);
        };
        SpanPaint paint;
        for (int i = 0; i < 4; ++i) {
            paint.color[i] = flat_ ? static_cast<float>(channel(a_, i)) : at(colors_[i]);
            paint.color_dx[i] = flat_ ? 0.0f : static_cast<float>(colors_[i].dx);
        }
        paint.u = at(u_);
        paint.v = at(v_);
        paint.u_dx = static_cast<float>(u_.dx);
        paint.v_dx = static_cast<float>(v_.dx);
        paint.texture = state_.texture;
        (paint.texture.texels ? state_.kernel.textured : state_.kernel.shaded)(pixels, count,
                                                                               paint);
    }

  private:
    static double to_pixels(int32_t coordinate) {
        return static_cast<double>(coordinate) / kSubpixels;
    }
    static double channel(const Corner& corner, int i) {
        return static_cast<double>(corner.rgba >> (8 * i) & 255);
    }

    const DrawState& state_;
    const Corner& a_;
    bool flat_;
    Plane colors_[4], u_, v_;
};

// Rows from `begin` on, up to where one of the two edges ends.
void rows(const DrawState& state, const Painter& painter, Edge& left, Edge& right, int begin,
          int end) {
    const PixelBox& clip = state.clip;
    for (int y = begin; y < end; ++y, left.next_row(), right.next_row()) {
        const auto x0 = std::max<int64_t>(left.x(), clip.x0);
        const auto x1 = std::min<int64_t>(right.x(), clip.x1);
        if (x0 < x1) painter.span(y, static_cast<int>(x0), static_cast<int>(x1 - x0));
    }
}

}  // namespace

void draw_triangle(const DrawState& state, const Corner& a, const Corner& b, const Corner& c) {
    const Corner *top = &a, *middle = &b, *bottom = &c;
    if (middle->y < top->y) std::swap(top, middle);
    if (bottom->y < middle->y) std::swap(middle, bottom);
    if (middle->y < top->y) std::swap(top, middle);
    const int begin = std::max(first_pixel(top->y), state.clip.y0);
    const int end = std::min(first_pixel(bottom->y), state.clip.y1);
    if (begin >= end) return;
    // Where the middle corner lies: right of the long edge if this is positive.
    const int64_t side = (int64_t{middle->x} - top->x) * (int64_t{bottom->y} - top->y) -
                         (int64_t{bottom->x} - top->x) * (int64_t{middle->y} - top->y);
    if (side == 0) return;
    const Painter painter(state, a, b, c);
    Edge longest(*top, *bottom, begin);
    const int turn = std::clamp(first_pixel(middle->y), begin, end);
    const auto half = [&](const Corner& from, const Corner& to, int first, int last) {
        if (first >= last) return;
        Edge edge(from, to, first);
        rows(state, painter, side > 0 ? longest : edge, side > 0 ? edge : longest, first, last);
    };
    half(*top, *middle, begin, turn);
    half(*middle, *bottom, turn, end);
}

}  // namespace kinora::play
