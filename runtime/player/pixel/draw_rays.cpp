// runtime/player/pixel/draw_rays.cpp: segments into the picture, and lines with soft edges.
#include "runtime/player/pixel/draw_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

constexpr double kHalfWidth = 0.75;  // of a line, pixels
constexpr double kEnd = 2.2;         // radius of the dot where a ray ends
constexpr double kFaint = 0.35;      // of a ray that meets nothing

struct Ink {
    uint8_t r, g, b;
};
constexpr Ink kEye = {240, 240, 240}, kTraced = {90, 190, 255}, kLit = {255, 205, 70},
              kBlocked = {235, 75, 65};

Ink ink_of(const StoryRay& ray) {
    switch (ray.kind) {
        case StoryRay::Kind::Eye:
            return kEye;
        case StoryRay::Kind::Traced:
            return kTraced;
        case StoryRay::Kind::Shadow:
            return ray.hit ? kBlocked : kLit;
    }
    return kEye;
}

// Pixels that ink is laid on.
class Canvas {
  public:
    Canvas(int width, int height, std::vector<uint8_t>& rgba)
        : width_(width), height_(height), rgba_(rgba) {}

    void line(dvec2 a, dvec2 b, Ink ink, double share) const {
        if (!clip(a, b)) return;
        const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
        auto turned = [&](dvec2 p) { return steep ? dvec2(p.y, p.x) : p; };
        dvec2 from = turned(a), to = turned(b);
        if (from.x > to.x) std::swap(from, to);
        const double slope = to.x > from.x ? (to.y - from.y) / (to.x - from.x) : 0;
        const double across = 1 / std::sqrt(1 + slope * slope);  // from along y to the distance
        for (int x = int(std::floor(from.x)); x <= int(std::floor(to.x)); ++x) {
            const double y = from.y + slope * (std::clamp(x + 0.5, from.x, to.x) - from.x);
            for (int row = int(std::floor(y)) - 2; row <= int(std::floor(y)) + 2; ++row) {
                const double away = std::abs(row + 0.5 - y) * across;
                const double covered = std::clamp(kHalfWidth + 0.5 - away, 0.0, 1.0) * share;
                steep ? lay(row, x, ink, covered) : lay(x, row, ink, covered);
            }
        }
    }

    void dot(dvec2 at, Ink ink) const {
        const int reach = int(kEnd) + 1;
        if (!(at.x > -reach && at.y > -reach && at.x < width_ + reach && at.y < height_ + reach))
            return;
        const int cx = int(std::floor(at.x)), cy = int(std::floor(at.y));
        for (int y = cy - reach; y <= cy + reach; ++y)
            for (int x = cx - reach; x <= cx + reach; ++x)
                lay(x, y, ink,
                    std::clamp(kEnd + 0.5 - std::hypot(x + 0.5 - at.x, y + 0.5 - at.y), 0.0, 1.0));
    }

  private:
    // Liang and Barsky, A New Concept and Method for Line Clipping, 1984; with a margin for the
    // line's width.
    bool clip(dvec2& a, dvec2& b) const {
        const double margin = 4;
        double first = 0, last = 1;
        auto edge = [&](double inside, double step) {  // inside + t * step >= 0
            if (step == 0) return inside >= 0;
            const double t = -inside / step;
            (step > 0 ? first : last) = step > 0 ? std::max(first, t) : std::min(last, t);
            return first <= last;
        };
        const dvec2 d = b - a;
        const bool seen = edge(a.x + margin, d.x) && edge(width_ + margin - a.x, -d.x) &&
                          edge(a.y + margin, d.y) && edge(height_ + margin - a.y, -d.y);
        if (!seen) return false;
        const dvec2 start = a;
        a = start + first * d;
        b = start + last * d;
        return true;
    }

    void lay(int x, int y, Ink ink, double share) const {
        if (share <= 0 || x < 0 || y < 0 || x >= width_ || y >= height_) return;
        uint8_t* to = &rgba_[4 * (size_t(y) * size_t(width_) + size_t(x))];
        const uint8_t from[4] = {ink.r, ink.g, ink.b, 255};
        for (int c = 0; c < 4; ++c)
            to[c] = uint8_t(std::lround(to[c] + share * (double(from[c]) - to[c])));
    }

    int width_, height_;
    std::vector<uint8_t>& rgba_;
};

}  // namespace

std::optional<std::pair<dvec2, dvec2>> seen_segment(const raytrace::Camera& camera, dvec3 origin,
                                                    dvec3 from, dvec3 to) {
    dvec3 a = from - origin - camera.eye, b = to - origin - camera.eye;
    double za = glm::dot(a, camera.forward), zb = glm::dot(b, camera.forward);
    if (!camera.orthographic) {
        const double nearest = 1e-4 * std::max(za, zb);
        if (!(nearest > 0)) return std::nullopt;
        const dvec3 start = a, d = b - a;
        auto at_nearest = [&] { return start + (nearest - za) / (zb - za) * d; };
        if (za < nearest) a = at_nearest();
        if (zb < nearest) b = at_nearest();
    }
    auto pixel = [&](dvec3 p) {
        if (!camera.orthographic) p /= glm::dot(p, camera.forward);
        const dvec3 &dx = camera.raster_dx, &dy = camera.raster_dy;
        return dvec2(camera.axis.x + glm::dot(p, dx) / glm::dot(dx, dx),
                     camera.axis.y + glm::dot(p, dy) / glm::dot(dy, dy));
    };
    return std::pair(pixel(a), pixel(b));
}

void draw_rays(std::span<const StoryRay> rays, const raytrace::Camera& camera, dvec3 origin,
               int width, int height, std::vector<uint8_t>& rgba) {
    if (camera.width < 1 || camera.height < 1) return;
    const Canvas canvas(width, height, rgba);
    const dvec2 scale(double(width) / camera.width, double(height) / camera.height);
    for (const StoryRay& ray : rays) {
        const auto seen = seen_segment(camera, origin, ray.from, ray.to);
        if (!seen) continue;
        const bool arrives = ray.hit || ray.kind == StoryRay::Kind::Shadow;
        canvas.line(seen->first * scale, seen->second * scale, ink_of(ray), arrives ? 0.9 : kFaint);
        if (ray.hit) canvas.dot(seen->second * scale, ink_of(ray));
    }
}

}  // namespace kinora
