// runtime/scene/tessellate/grid.cpp: samples, those that are at one place, and triangles.
#include "runtime/scene/tessellate/grid_p.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace kinora::tessellation {

namespace {

constexpr double kSamePlace = 1e-12;    // of the largest coordinate
constexpr double kNoNormal = 1e-9;      // of the largest derivatives' product
constexpr size_t kLimitNormals = 4096;  // beside as many as both directions have lines

double largest_coordinate(const Grid& grid) {
    double largest = 0;
    for (dvec3 p : grid.places)
        if (is_finite(p))
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest;
}

class Places {
  public:
    explicit Places(Grid& grid) : grid_(grid), position_(grid.position) {
        position_.resize(grid.samples());
        std::iota(position_.begin(), position_.end(), 0u);
        const double within = kSamePlace * largest_coordinate(grid);
        square_ = within * within;
    }

    void join(size_t a, size_t b) {
        dvec3 to = grid_.places[a] - grid_.places[b];
        if (!(glm::dot(to, to) <= square_)) return;
        uint32_t first = root(uint32_t(a)), second = root(uint32_t(b));
        position_[std::max(first, second)] = std::min(first, second);
    }

    void finish() {
        for (uint32_t k = 0; k < position_.size(); ++k) position_[k] = position_[position_[k]];
    }

  private:
    uint32_t root(uint32_t k) {
        while (position_[k] != k) k = position_[k] = position_[position_[k]];
        return k;
    }

    Grid& grid_;
    std::vector<uint32_t>& position_;
    double square_;
};

// Patches that meet, edges that are points, and ends of a direction that closes.
void join_places(Grid& grid) {
    Places places(grid);
    const size_t width = grid.u.size(), height = grid.v.size();
    for (size_t j = 0; j < height; ++j)
        for (size_t i = 0; i < width; ++i) {
            const size_t k = j * width + i;
            if (i > 0) places.join(k, k - 1);
            if (j > 0) places.join(k, k - width);
            if (i == width - 1) places.join(k, j * width);
            if (j == height - 1) places.join(k, i);
        }
    places.finish();
}

}  // namespace

dvec3 Grid::place(uint32_t corner) const {
    if (corner < samples()) return places[position[corner]];
    const SampleBlend& blend = blends[corner - samples()];
    dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k) sum += blend.weight[k] * places[position[blend.sample[k]]];
    return sum;
}

Grid sample_grid(const Sheet& sheet, const Fineness& fineness) {
    Grid grid;
    grid.u = make_lines(fineness.u, fineness.merged);
    grid.v = make_lines(fineness.v, fineness.merged);
    grid.places.resize(grid.samples());
    grid.normals.resize(grid.samples());
    double longest_u = 0, longest_v = 0;  // squares
    sheet.sample(grid.u, grid.v, false, [&](size_t sample, const Jet& jet) {
        grid.places[sample] = jet.p;
        grid.normals[sample] = glm::cross(jet.u, jet.v);
        longest_u = std::max(longest_u, glm::dot(jet.u, jet.u));
        longest_v = std::max(longest_v, glm::dot(jet.v, jet.v));
    });
    const double least = kNoNormal * std::sqrt(longest_u) * std::sqrt(longest_v);
    size_t limits = kLimitNormals + grid.u.size() + grid.v.size();
    for (size_t k = 0; k < grid.samples(); ++k) {
        dvec3& n = grid.normals[k];
        const double length = glm::length(n);
        if (length > least && std::isfinite(length)) {
            n /= length;
            continue;
        }
        n = dvec3(0.0);
        if (limits == 0 || !is_finite(grid.places[k])) continue;
        --limits;
        n = unit_normal(sheet, grid.u[k % grid.u.size()], grid.v[k / grid.u.size()]);
    }
    join_places(grid);
    return grid;
}

void add_triangle(Grid& grid, uint32_t a, uint32_t b, uint32_t c) {
    constexpr double kNoHeight = 1e-11;  // of the longest edge
    const dvec3 p = grid.place(a), q = grid.place(b), r = grid.place(c);
    const dvec3 pq = q - p, pr = r - p, qr = r - q;
    const double longest = std::max({glm::dot(pq, pq), glm::dot(pr, pr), glm::dot(qr, qr)});
    const dvec3 cross = glm::cross(pq, pr);
    if (!(glm::dot(cross, cross) > kNoHeight * kNoHeight * longest * longest)) return;
    for (uint32_t k : {a, b, c}) grid.corners.push_back(k);
}

void add_cell(Grid& grid, size_t i, size_t j) {
    const uint32_t width = uint32_t(grid.u.size());
    const uint32_t a = uint32_t(j * width + i), b = a + 1, c = a + width, d = c + 1;
    const dvec3 p[4] = {grid.place(a), grid.place(b), grid.place(c), grid.place(d)};
    for (dvec3 corner : p)
        if (!is_finite(corner)) return;
    const dvec3 up = p[3] - p[0], down = p[2] - p[1];
    if (glm::dot(up, up) <= glm::dot(down, down)) {
        add_triangle(grid, a, b, d);
        add_triangle(grid, a, d, c);
    } else {
        add_triangle(grid, a, b, c);
        add_triangle(grid, b, d, c);
    }
}

void fill_normals(Grid& grid) {
    // The samples that a corner is made of.
    auto each_sample = [&](uint32_t corner, auto&& f) {
        if (corner < grid.samples()) return f(corner);
        for (uint32_t sample : grid.blends[corner - grid.samples()].sample) f(sample);
    };
    std::vector<uint8_t> open(grid.samples(), 0);
    bool any = false;
    for (uint32_t corner : grid.corners)
        each_sample(corner, [&](uint32_t sample) {
            if (grid.normals[sample] != dvec3(0.0)) return;
            open[sample] = 1;
            any = true;
        });
    if (!any) return;
    for (size_t k = 0; k < grid.corners.size(); k += 3) {
        const dvec3 p = grid.place(grid.corners[k]);
        const dvec3 face =
            glm::cross(grid.place(grid.corners[k + 1]) - p, grid.place(grid.corners[k + 2]) - p);
        for (size_t c = k; c < k + 3; ++c)
            each_sample(grid.corners[c], [&](uint32_t sample) {
                if (open[sample]) grid.normals[sample] += face;
            });
    }
    for (uint32_t k = 0; k < open.size(); ++k) {
        if (!open[k]) continue;
        const double length = glm::length(grid.normals[k]);
        grid.normals[k] =
            length > 0 && std::isfinite(length) ? grid.normals[k] / length : dvec3(0, 0, 1);
    }
}

}  // namespace kinora::tessellation
