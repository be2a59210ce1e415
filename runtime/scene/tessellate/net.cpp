// runtime/scene/tessellate/net.cpp: meshes of patches and NURBS, blends of a net of control points.
#include <algorithm>
#include <cmath>

#include "runtime/scene/tessellate/basis_p.h"

namespace kinora::tessellation {

namespace {

constexpr size_t kManyPatches = 32;  // their ends show enough of how they bend

// The weights of several lines, one behind the other.
class LineWeights {
  public:
    LineWeights(const Basis& basis, std::span<const Line> lines, bool second)
        : order_(basis.direction->order), points_(basis.direction->points) {
        const uint32_t parts = second ? 3 : 2;
        stride_ = parts * order_;
        weights_.resize(lines.size() * stride_);
        first_.reserve(lines.size());
        Weights w;
        for (size_t k = 0; k < lines.size(); ++k) {
            basis.weights(basis, lines[k], w);
            first_.push_back(basis.direction->spans[lines[k].patch].first);
            double* to = &weights_[k * stride_];
            to = std::copy_n(w.value, order_, to);
            to = std::copy_n(w.first, order_, to);
            if (second) std::copy_n(w.second, order_, to);
        }
    }

    uint32_t order() const { return order_; }
    const double* value(size_t line) const { return &weights_[line * stride_]; }
    const double* first(size_t line) const { return value(line) + order_; }
    const double* second(size_t line) const { return value(line) + 2 * order_; }
    // A control point of a line, wrapped where the mesh is.
    uint32_t point(size_t line, uint32_t k) const {
        uint32_t at = first_[line] + k;
        return at < points_ ? at : at % points_;
    }

    // The control points of all lines, each once.
    std::vector<uint32_t> used() const {
        std::vector<uint8_t> marked(points_, 0);
        std::vector<uint32_t> result;
        for (size_t line = 0; line < first_.size(); ++line) {
            if (line > 0 && first_[line] == first_[line - 1]) continue;
            for (uint32_t k = 0; k < order_; ++k) {
                uint32_t p = point(line, k);
                if (!marked[p]) result.push_back(p);
                marked[p] = 1;
            }
        }
        return result;
    }

  private:
    uint32_t order_, points_;
    size_t stride_ = 0;
    std::vector<double> weights_;
    std::vector<uint32_t> first_;
};

// A blend of four-vectors and its derivatives.
struct Jet4 {
    dvec4 p{0.0}, u{0.0}, v{0.0}, uu{0.0}, uv{0.0}, vv{0.0};
};

Jet plain(const Jet4& h) {
    return {dvec3(h.p), dvec3(h.u), dvec3(h.v), dvec3(h.uu), dvec3(h.uv), dvec3(h.vv)};
}

// With P = X / w: X = w P, derived by the product rule.
Jet divided(const Jet4& h) {
    const double r = 1 / h.p.w;
    Jet j;
    j.p = r * dvec3(h.p);
    j.u = r * (dvec3(h.u) - h.u.w * j.p);
    j.v = r * (dvec3(h.v) - h.v.w * j.p);
    j.uu = r * (dvec3(h.uu) - 2 * h.u.w * j.u - h.uu.w * j.p);
    j.vv = r * (dvec3(h.vv) - 2 * h.v.w * j.v - h.vv.w * j.p);
    j.uv = r * (dvec3(h.uv) - h.u.w * j.v - h.v.w * j.u - h.uv.w * j.p);
    return j;
}

// The control points of a row, blended across the rows of one line of v.
struct BlendedRow {
    std::vector<dvec4> value, first, second;
};

class Net : public Sheet {
  public:
    bool take(const CurvedSurface& surface) {
        if (surface.u.points == 0 || surface.v.points == 0 ||
            surface.points.size() / surface.u.points < surface.v.points)
            return false;
        std::optional<Basis> basis_u = make_basis(surface.kind, surface.u, u);
        std::optional<Basis> basis_v = make_basis(surface.kind, surface.v, v);
        if (!basis_u || !basis_v) return false;
        basis_u_ = *std::move(basis_u);
        basis_v_ = *std::move(basis_v);
        points_ = surface.points;
        rational_ = surface.rational;
        for (Direction* direction : {&u, &v}) {
            if (rational_) direction->lattice += 2;
            if (direction->spans.size() > kManyPatches) direction->lattice = 2;
        }
        return true;
    }

    void sample(std::span<const Line> lines_u, std::span<const Line> lines_v, bool second,
                JetSink sink) const override {
        const LineWeights a(basis_u_, lines_u, second), b(basis_v_, lines_v, second);
        const std::vector<uint32_t> used = a.used();
        BlendedRow row{std::vector<dvec4>(u.points), std::vector<dvec4>(u.points),
                       std::vector<dvec4>(second ? u.points : 0)};
        size_t sample = 0;
        for (size_t line = 0; line < lines_v.size(); ++line) {
            blend_rows(b, line, used, second, row);
            for (size_t k = 0; k < lines_u.size(); ++k) {
                Jet4 h = second ? along<true>(a, k, row) : along<false>(a, k, row);
                sink(sample++, rational_ ? divided(h) : plain(h));
            }
        }
    }

    std::vector<float> blend(std::span<const float> values, uint32_t components,
                             std::span<const Line> lines_u,
                             std::span<const Line> lines_v) const override {
        const LineWeights a(basis_u_, lines_u, false), b(basis_v_, lines_v, false);
        const std::vector<uint32_t> used = a.used();
        std::vector<double> row(size_t(u.points) * components);
        std::vector<float> result;
        result.reserve(lines_u.size() * lines_v.size() * components);
        for (size_t line = 0; line < lines_v.size(); ++line) {
            for (uint32_t p : used)
                for (uint32_t c = 0; c < components; ++c) {
                    double sum = 0;
                    for (uint32_t k = 0; k < b.order(); ++k)
                        sum += b.value(line)[k] *
                               values[(size_t(b.point(line, k)) * u.points + p) * components + c];
                    row[size_t(p) * components + c] = sum;
                }
            for (size_t k = 0; k < lines_u.size(); ++k)
                for (uint32_t c = 0; c < components; ++c) {
                    double sum = 0;
                    for (uint32_t r = 0; r < a.order(); ++r)
                        sum += a.value(k)[r] * row[size_t(a.point(k, r)) * components + c];
                    result.push_back(float(sum));
                }
        }
        return result;
    }

  private:
    void blend_rows(const LineWeights& b, size_t line, const std::vector<uint32_t>& used,
                    bool second, BlendedRow& row) const {
        for (uint32_t p : used) {
            dvec4 value(0.0), first(0.0), curved(0.0);
            for (uint32_t k = 0; k < b.order(); ++k) {
                const dvec4& point = points_[size_t(b.point(line, k)) * u.points + p];
                value += b.value(line)[k] * point;
                first += b.first(line)[k] * point;
                if (second) curved += b.second(line)[k] * point;
            }
            row.value[p] = value;
            row.first[p] = first;
            if (second) row.second[p] = curved;
        }
    }

    template <bool kSecond>
    static Jet4 along(const LineWeights& a, size_t line, const BlendedRow& row) {
        Jet4 h;
        const double *value = a.value(line), *first = a.first(line);
        for (uint32_t k = 0; k < a.order(); ++k) {
            const uint32_t p = a.point(line, k);
            h.p += value[k] * row.value[p];
            h.u += first[k] * row.value[p];
            h.v += value[k] * row.first[p];
            if constexpr (kSecond) {
                h.uu += a.second(line)[k] * row.value[p];
                h.uv += first[k] * row.first[p];
                h.vv += value[k] * row.second[p];
            }
        }
        return h;
    }

    Basis basis_u_, basis_v_;
    std::span<const dvec4> points_;
    bool rational_ = false;
};

}  // namespace

std::unique_ptr<Sheet> make_net(const CurvedSurface& surface) {
    auto net = std::make_unique<Net>();
    if (!net->take(surface)) return nullptr;
    return net;
}

}  // namespace kinora::tessellation
