// runtime/scene/tessellate/attributes.cpp: normals, texture coordinates and variables of samples.
#include "runtime/scene/tessellate/attributes_p.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

namespace kinora::tessellation {

namespace {

constexpr uint32_t kMostComponents = 64;
constexpr float kSameNormal = 1e-3f;  // files round points of smooth meshes
constexpr float kSameValue = 1e-6f;   // of the value

// How many values of each rate a surface has.
size_t value_count(const CurvedSurface& surface, const Sheet& sheet, VariableRate rate) {
    const Direction &u = sheet.u, &v = sheet.v;
    const size_t vertices = is_quadric(surface.kind) ? 4 : size_t(u.points) * v.points;
    const size_t corners = size_t(u.corners()) * v.corners();
    const size_t counts[] = {1, size_t(u.segments) * v.segments, corners, vertices, corners};
    return counts[size_t(rate)];
}

class Attributes {
  public:
    Attributes(const CurvedSurface& surface, const Sheet& sheet, const Grid& grid)
        : surface_(surface), sheet_(sheet), grid_(grid) {}

    std::vector<VertexAttribute> make() {
        result_.push_back(entries("NORMAL", 3, normals(), kSameNormal));
        result_.push_back(entries("TEXCOORD", 2, texture_coordinates(), 0));
        result_.push_back(entries(kSurfaceParameters, 2, parameters(false), 0));
        for (const SurfaceVariable& variable : surface_.variables) {
            if (named("N", 3) == &variable || named("st", 2) == &variable) continue;
            if (!named("st", 2) && (named("s", 1) == &variable || named("t", 1) == &variable))
                continue;
            if (sound(variable)) result_.push_back(attribute(variable));
        }
        return std::move(result_);
    }

  private:
    bool sound(const SurfaceVariable& variable) const {
        if (variable.components == 0 || variable.components > kMostComponents) return false;
        return variable.values.size() / variable.components >=
               value_count(surface_, sheet_, variable.rate);
    }
    const SurfaceVariable* named(std::string_view name, uint32_t components) const {
        for (const SurfaceVariable& variable : surface_.variables)
            if (variable.name == name && variable.components == components && sound(variable))
                return &variable;
        return nullptr;
    }

    size_t patch_of(uint32_t corner) const {
        const size_t column = sheet_.u.spans[grid_.line_u(corner).patch].segment;
        return sheet_.v.spans[grid_.line_v(corner).patch].segment * sheet_.u.segments + column;
    }

    // A value for each sample, without the blends.
    std::vector<float> samples_of(const SurfaceVariable& variable) const {
        if (variable.rate == VariableRate::Vertex)
            return sheet_.blend(variable.values, variable.components, grid_.u, grid_.v);
        if (variable.rate != VariableRate::Constant && variable.rate != VariableRate::Uniform)
            return varying(variable);
        std::vector<float> values;
        values.reserve(grid_.samples() * variable.components);
        for (uint32_t k = 0; k < grid_.samples(); ++k) {
            const size_t at = variable.rate == VariableRate::Constant ? 0 : patch_of(k);
            const float* from = &variable.values[at * variable.components];
            values.insert(values.end(), from, from + variable.components);
        }
        return values;
    }

    std::vector<float> varying(const SurfaceVariable& variable) const {
        const uint32_t components = variable.components, width = sheet_.u.corners();
        std::vector<CornerBlend> along;
        for (const Line& line : grid_.u) along.push_back(corner_blend(sheet_.u, line));
        std::vector<float> values;
        values.reserve(grid_.samples() * components);
        auto value = [&](uint32_t i, uint32_t j, uint32_t c) {
            return double(variable.values[(size_t(j) * width + i) * components + c]);
        };
        for (const Line& line : grid_.v) {
            const CornerBlend b = corner_blend(sheet_.v, line);
            for (const CornerBlend& a : along)
                for (uint32_t c = 0; c < components; ++c)
                    values.push_back(
                        float(bilinear(value(a.from, b.from, c), value(a.to, b.from, c),
                                       value(a.from, b.to, c), value(a.to, b.to, c), a.t, b.t)));
        }
        return values;
    }

    // The surface's parameters of each sample, or their part of the whole range.
    std::vector<float> parameters(bool parts) const {
        auto along = [&](const Direction& direction, const std::vector<Line>& lines) {
            const double low = direction.spans.front().low, high = direction.spans.back().high;
            std::vector<float> result;
            for (const Line& line : lines) {
                double value = direction.parameter(line);
                result.push_back(float(parts ? (value - low) / (high - low) : value));
            }
            return result;
        };
        const std::vector<float> us = along(sheet_.u, grid_.u), vs = along(sheet_.v, grid_.v);
        std::vector<float> values;
        values.reserve(2 * grid_.samples());
        for (float v : vs)
            for (float u : us) {
                values.push_back(u);
                values.push_back(v);
            }
        return values;
    }

    std::vector<float> texture_coordinates() const {
        if (const SurfaceVariable* st = named("st", 2)) return samples_of(*st);
        std::vector<float> values = parameters(true);
        const double* c = surface_.corners;
        for (size_t k = 0; k < values.size(); k += 2) {
            const double u = values[k], v = values[k + 1];
            for (size_t i = 0; i < 2; ++i)
                values[k + i] = float(bilinear(c[i], c[2 + i], c[4 + i], c[6 + i], u, v));
        }
        const char* names[] = {"s", "t"};
        for (size_t i = 0; i < 2; ++i)
            if (const SurfaceVariable* given = named(names[i], 1)) {
                const std::vector<float> own = samples_of(*given);
                for (size_t k = 0; k < own.size(); ++k) values[2 * k + i] = own[k];
            }
        return values;
    }

    std::vector<float> normals() const {
        const double side = surface_.reversed ? -1 : 1;
        std::vector<float> values;
        values.reserve(3 * grid_.samples());
        for (dvec3 n : grid_.normals)
            for (int c = 0; c < 3; ++c) values.push_back(float(side * n[c]));
        const SurfaceVariable* given = named("N", 3);
        if (!given) return values;
        const std::vector<float> own = samples_of(*given);
        for (size_t k = 0; k < own.size(); k += 3) {
            const dvec3 n(own[k], own[k + 1], own[k + 2]);
            const double length = glm::length(n);
            if (!(length > 0) || !std::isfinite(length)) continue;
            for (int c = 0; c < 3; ++c) values[k + size_t(c)] = float(n[c] / length);
        }
        return values;
    }

    VertexAttribute attribute(const SurfaceVariable& variable) const {
        const uint32_t components = variable.components;
        if (variable.rate != VariableRate::Constant && variable.rate != VariableRate::Uniform)
            return entries(variable.name, components, samples_of(variable), kSameValue);
        VertexAttribute result{variable.name, 0, components, {}, {}};
        const size_t count = value_count(surface_, sheet_, variable.rate);
        result.values.assign(variable.values.begin(),
                             variable.values.begin() + ptrdiff_t(count * components));
        for (uint32_t corner : grid_.corners)
            result.corners.push_back(
                variable.rate == VariableRate::Constant ? 0 : uint32_t(patch_of(corner)));
        return result;
    }

    // The sample before that may be the same place of the surface, for the seam between patches
    // in one direction and for the ends where it closes.
    static constexpr size_t kNoTwin = ~size_t(0);
    size_t twin(size_t sample, bool along_u) const {
        const std::vector<Line>& lines = along_u ? grid_.u : grid_.v;
        const size_t width = grid_.u.size(), stride = along_u ? 1 : width;
        const size_t at = along_u ? sample % width : sample / width;
        if (at == 0) return kNoTwin;
        if (lines[at].first) return sample - stride;
        if (at + 1 < lines.size()) return kNoTwin;
        const size_t start = sample - at * stride;
        return grid_.position[start] == grid_.position[sample] ? start : kNoTwin;
    }

    // For each sample the first one whose value it shares.
    std::vector<uint32_t> shared(const std::vector<float>& values, uint32_t stride,
                                 float tolerance) const {
        std::vector<uint32_t> result(grid_.samples());
        std::iota(result.begin(), result.end(), 0u);
        auto same = [&](size_t a, size_t b) {
            for (uint32_t c = 0; c < stride; ++c) {
                const float x = values[a * stride + c], y = values[b * stride + c];
                if (!(std::abs(x - y) <= tolerance * std::max(1.0f, std::abs(x)))) return false;
            }
            return true;
        };
        for (size_t k = 0; k < result.size(); ++k)
            for (bool along_u : {true, false}) {
                const size_t before = twin(k, along_u);
                if (before == kNoTwin || !same(k, before)) continue;
                result[k] = result[before];
                break;
            }
        return result;
    }

    static void append(const SampleBlend& blend, uint32_t stride, bool unit,
                       std::vector<float>& values) {
        constexpr double kLeastLength = 1e-6;  // of opposite normals' mean
        double sums[kMostComponents] = {}, square = 0;
        for (uint32_t c = 0; c < stride; ++c) {
            for (int k = 0; k < 3; ++k)
                sums[c] += blend.weight[k] * values[size_t(blend.sample[k]) * stride + c];
            square += sums[c] * sums[c];
        }
        const double length = unit ? std::sqrt(square) : 1;
        for (uint32_t c = 0; c < stride; ++c)
            values.push_back(length > kLeastLength ? float(sums[c] / length)
                                                   : values[size_t(blend.sample[0]) * stride + c]);
    }

    // An attribute of samples' values; those that triangles use, each once.
    VertexAttribute entries(std::string semantic, uint32_t stride, std::vector<float> values,
                            float tolerance) const {
        std::vector<uint32_t> first = shared(values, stride, tolerance);
        const bool unit = semantic == "NORMAL";
        for (const SampleBlend& blend : grid_.blends) {
            first.push_back(uint32_t(first.size()));
            append(blend, stride, unit, values);
        }
        VertexAttribute result{std::move(semantic), 0, stride, {}, {}};
        result.corners.reserve(grid_.corners.size());
        std::vector<uint32_t> number(first.size(), kNone);
        uint32_t count = 0;
        for (uint32_t corner : grid_.corners) {
            const uint32_t entry = first[corner];
            if (number[entry] == kNone) {
                number[entry] = count++;
                const float* from = &values[size_t(entry) * stride];
                result.values.insert(result.values.end(), from, from + stride);
            }
            result.corners.push_back(number[entry]);
        }
        return result;
    }

    const CurvedSurface& surface_;
    const Sheet& sheet_;
    const Grid& grid_;
    std::vector<VertexAttribute> result_;
};

}  // namespace

std::vector<VertexAttribute> make_attributes(const CurvedSurface& surface, const Sheet& sheet,
                                             const Grid& grid) {
    return Attributes(surface, sheet, grid).make();
}

}  // namespace kinora::tessellation
