// runtime/scene/vertices/dice_parts.cpp: large triangles cut into parts; parts split by several
// threads.
#include "runtime/scene/vertices/dice_parts.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <glm/geometric.hpp>

#include "runtime/scene/description/pair_numbers.h"
#include "runtime/scene/vertices/weld.h"

namespace kinora {

namespace {

// An edge of a part is at most so many times as long as those it is split into: some thousand
// triangles, of which a tenth are at its rim.
constexpr double kPartEdge = 64;

// The edges of marked groups, between welded positions.
class MarkedEdges {
  public:
    MarkedEdges(const Mesh& base, std::span<const uint8_t> diced) : welded_(weld(base.positions)) {
        for (size_t g = 0; g < base.groups.size(); ++g) {
            if (!diced[g]) continue;
            const std::vector<uint32_t>& t = base.groups[g].triangles;
            for (size_t c = 0; c < t.size(); ++c) {
                auto [a, b] = ends(t[c], t[c - c % 3 + (c + 1) % 3]);
                edges_.number(a, b, 0);
            }
        }
    }
    bool contains(uint32_t p, uint32_t q) const {
        auto [a, b] = ends(p, q);
        return edges_.contains(a, b);
    }

  private:
    std::pair<uint32_t, uint32_t> ends(uint32_t p, uint32_t q) const {
        return std::minmax({welded_[p], welded_[q]});
    }
    std::vector<uint32_t> welded_;
    PairNumbers edges_;
};

DiceMetric metric_of(const Mesh& base, const uint32_t corners[3]) {
    dvec3 p0(base.positions[corners[0]]);
    dvec3 e1 = dvec3(base.positions[corners[1]]) - p0, e2 = dvec3(base.positions[corners[2]]) - p0;
    return {glm::dot(e1, e1), glm::dot(e1, e2), glm::dot(e2, e2)};
}

// Of a group that is not diced: only what lies on marked edges of the triangle is split.
bool on_marked_edge(const MarkedEdges& marked, const uint32_t corners[3], DicePoint a,
                    DicePoint b) {
    for (int k = 0; k < 3; ++k)
        if (a.weight(k) == 0 && b.weight(k) == 0)
            return marked.contains(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    return false;
}

// Whether p lies on the line through a and b.
bool in_line(DicePoint a, DicePoint b, DicePoint p) {
    auto less = [](uint32_t x, uint32_t y) { return int64_t(x) - int64_t(y); };
    return less(b.i, a.i) * less(p.j, a.j) == less(b.j, a.j) * less(p.i, a.i);
}

bool at_rim(const DiceCorners& whole, DicePoint p) {
    return in_line(whole[0], whole[1], p) || in_line(whole[1], whole[2], p) ||
           in_line(whole[2], whole[0], p);
}

// What a thread works with.
struct Worker {
    TriangleDicer dicer;
    DicedTriangle made;
    std::vector<uint32_t> rim;
    Arena memory{512 << 10};

    template <class T>
    std::span<const T> keep(const std::vector<T>& numbers) {
        std::span<T> kept = memory.allocate_span<T>(numbers.size());
        std::ranges::copy(numbers, kept.begin());
        return kept;
    }
};

// The triangles of one group.
class GroupParts {
  public:
    GroupParts(const Mesh& base, const MeshGroup& group, const MarkedEdges* marked, DiceTest longer,
               size_t limit, std::span<Worker> workers, std::atomic<size_t>& total)
        : base_(base),
          group_(group),
          marked_(marked),
          longer_(longer),
          limit_(limit),
          workers_(workers),
          total_(total) {}

    std::vector<DicedPart> run() {
        const size_t count = group_.triangles.size() / 3;
        std::vector<DicedTriangle> cuts(count);  // of large triangles
        std::vector<DicedPart> parts(count);
        parallel_for(0, count, 16, [&](size_t begin, size_t end) {
            Worker& worker = workers_[size_t(thread_index())];
            for (size_t t = begin; t < end && !over_limit(); ++t) {
                parts[t].triangle = uint32_t(t);
                with_rule(t, [&](const DiceMetric& metric, EdgeRule rule) {
                    if (is_large(rule) &&
                        !worker.dicer.cut(metric, rule, kPartEdge, limit_, cuts[t]))
                        total_ += limit_ + 1;
                });
                if (is_cut(cuts[t])) continue;
                dice(worker, kWholeTriangle, parts[t]);
                if (worker.made.triangles.size() > 3) keep(worker, kWholeTriangle, parts[t]);
            }
        });
        if (over_limit()) return {};
        return std::ranges::any_of(cuts, is_cut) ? with_cuts(std::move(parts), cuts)
                                                 : std::move(parts);
    }

  private:
    static bool is_cut(const DicedTriangle& cut) { return cut.triangles.size() > 3; }
    bool over_limit() const { return total_.load(std::memory_order_relaxed) > limit_; }

    template <class F>
    void with_rule(size_t triangle, F&& f) const {
        const uint32_t* corners = &group_.triangles[3 * triangle];
        auto rule = [&](DicePoint a, DicePoint b, double times) {
            return (!marked_ || on_marked_edge(*marked_, corners, a, b)) &&
                   longer_(corners, a, b, times);
        };
        f(metric_of(base_, corners), rule);
    }

    static bool is_large(EdgeRule rule) {
        for (size_t k = 0; k < 3; ++k)
            if (rule(kWholeTriangle[k], kWholeTriangle[(k + 1) % 3], kPartEdge)) return true;
        return false;
    }

    void dice(Worker& worker, const DiceCorners& whole, const DicedPart& part) const {
        bool fits = false;
        with_rule(part.triangle, [&](const DiceMetric& metric, EdgeRule rule) {
            fits = worker.dicer.dice(metric, rule, whole, limit_, worker.made);
        });
        total_ += fits ? worker.made.triangles.size() / 3 : limit_ + 1;
    }

    static void keep(Worker& worker, const DiceCorners& whole, DicedPart& part) {
        const std::vector<DicePoint>& points = worker.made.points;
        worker.rim.clear();
        for (uint32_t n = 0; n < points.size(); ++n)
            if (at_rim(whole, points[n])) worker.rim.push_back(n);
        part.points = worker.keep(points);
        part.triangles = worker.keep(worker.made.triangles);
        part.rim = worker.keep(worker.rim);
    }

    // Puts the parts of large triangles in the place of these, and dices them.
    std::vector<DicedPart> with_cuts(std::vector<DicedPart> of_small,
                                     std::span<const DicedTriangle> cuts) const {
        std::vector<DicedPart> parts;
        std::vector<std::pair<uint32_t, DiceCorners>> todo;  // by part that is still to be diced
        for (size_t t = 0; t < of_small.size(); ++t) {
            if (!is_cut(cuts[t])) {
                parts.push_back(std::move(of_small[t]));
                continue;
            }
            for (size_t c = 0; c < cuts[t].triangles.size(); c += 3) {
                auto at = [&](size_t k) { return cuts[t].points[cuts[t].triangles[c + k]]; };
                todo.emplace_back(uint32_t(parts.size()), DiceCorners{at(0), at(1), at(2)});
                parts.emplace_back().triangle = uint32_t(t);
            }
        }
        parallel_for(0, todo.size(), 1, [&](size_t begin, size_t end) {
            Worker& worker = workers_[size_t(thread_index())];
            for (size_t k = begin; k < end && !over_limit(); ++k) {
                dice(worker, todo[k].second, parts[todo[k].first]);
                keep(worker, todo[k].second, parts[todo[k].first]);
            }
        });
        return parts;
    }

    const Mesh& base_;
    const MeshGroup& group_;
    const MarkedEdges* marked_;  // null: all edges may be split
    DiceTest longer_;
    size_t limit_;
    std::span<Worker> workers_;
    std::atomic<size_t>& total_;
};

}  // namespace

std::optional<DicedParts> dice_parts(const Mesh& base, std::span<const uint8_t> diced,
                                     DiceTest longer, size_t limit) {
    const MarkedEdges marked(base, diced);
    std::vector<Worker> workers{size_t(thread_count())};
    std::atomic<size_t> total{0};
    DicedParts result;
    for (size_t g = 0; g < base.groups.size(); ++g) {
        GroupParts group(base, base.groups[g], diced[g] ? nullptr : &marked, longer, limit, workers,
                         total);
        result.groups.push_back(group.run());
    }
    if (total > limit) return std::nullopt;
    result.triangles = total;
    for (Worker& worker : workers) result.memory.push_back(std::move(worker.memory));
    return result;
}

}  // namespace kinora
