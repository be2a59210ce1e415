// runtime/programs/shade/point_set.cpp: given variables, the values of missing ones, derivatives.
#include "runtime/programs/shade/point_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "jit/ir/ir.h"
#include "raytrace/sampling.h"

namespace kinora {

namespace {

using rsl::Global;
using rsl::KeyKind;
using rsl::Partial;

constexpr Global kGiven[] = {Global::P,  Global::N,  Global::Ng,   Global::I,
                             Global::s,  Global::t,  Global::u,    Global::v,
                             Global::du, Global::dv, Global::dPdu, Global::dPdv};
constexpr Global kGivenUniform[] = {Global::time, Global::dtime, Global::E};

}  // namespace

PointSet::PointSet(const PointsDocument& document) : document_(document) {
    for (Global id : kGiven) given(id);
    for (Global id : kGivenUniform) given(id);
    missing();
}

dmat4 PointSet::current_from_space(std::string_view name) const {
    auto found = document_.spaces.find(std::string(name));
    return found == document_.spaces.end() ? dmat4(1.0) : found->second;
}

std::span<const float> PointSet::row(Global id, int component) const {
    return rows_[size_t(id)][component];
}

void PointSet::given(Global id) {
    const rsl::GlobalInfo& info = rsl::global_info(id);
    std::string name(info.name);
    auto found = document_.variables.find(name);
    if (found == document_.variables.end()) return;
    FittedValue fitted = fit_value(name, found->second, info.type, count());
    bool uniform = info.rate != rsl::Rate::Varying;
    if (uniform && fitted.per_point) throw PointsError(name + ": has one value for all points");
    size_t width = size_t(rsl::component_count(info.type.base));
    for (size_t c = 0; c < width; ++c) {
        Row& row = global(id, int(c));
        row.resize(count());
        for (size_t i = 0; i < count(); ++i)
            row[i] = float(fitted.value.numbers[fitted.per_point ? i * width + c : c]);
    }
}

void PointSet::fill_with(Global id, float x, float y, float z) {
    float numbers[] = {x, y, z};
    int width = rsl::component_count(rsl::global_info(id).type.base);
    for (int c = 0; c < width; ++c) global(id, c).assign(count(), numbers[c]);
}

// Half the way between the neighbours on the grid, a whole step at its edge.
double PointSet::change(std::span<const float> values, size_t point, Partial partial) const {
    size_t columns = document_.columns, stride = partial == Partial::Du ? 1 : columns;
    if (columns == 0) return 0;
    size_t at = partial == Partial::Du ? point % columns : point / columns;
    size_t last = (partial == Partial::Du ? columns : document_.rows) - 1;
    if (last == 0) return 0;
    size_t before = at > 0 ? point - stride : point, behind = at < last ? point + stride : point;
    return (double(values[behind]) - double(values[before])) / (at > 0 && at < last ? 2.0 : 1.0);
}

PointSet::Row PointSet::along(std::span<const float> values, Partial partial) const {
    std::span<const float> parameter = row(partial == Partial::Du ? Global::u : Global::v, 0);
    Row result(count(), 0.0f);
    for (size_t i = 0; i < count(); ++i) {
        double step = change(parameter, i, partial);
        if (step != 0) result[i] = float(change(values, i, partial) / step);
    }
    return result;
}

void PointSet::find_edges(bool given_too) {
    for (auto [id, partial] :
         {std::pair(Global::dPdu, Partial::Du), std::pair(Global::dPdv, Partial::Dv)})
        for (int c = 0; c < 3 && (given_too || !is_given(id)); ++c)
            global(id, c) = along(row(Global::P, c), partial);
}

void PointSet::missing() {
    size_t columns = document_.columns, rows = document_.rows;
    auto share = [](size_t at, size_t all) {
        return all > 1 ? float(double(at) / double(all - 1)) : 0.0f;
    };
    for (Global id : {Global::u, Global::v}) {
        if (has(id)) continue;
        fill_with(id, 0, 0, 0);
        for (size_t i = 0; columns > 0 && i < count(); ++i)
            global(id, 0)[i] =
                id == Global::u ? share(i % columns, columns) : share(i / columns, rows);
    }
    if (!has(Global::s)) global(Global::s, 0) = global(Global::u, 0);
    if (!has(Global::t)) global(Global::t, 0) = global(Global::v, 0);
    for (auto [id, of, partial] : {std::tuple(Global::du, Global::u, Partial::Du),
                                   std::tuple(Global::dv, Global::v, Partial::Dv)}) {
        if (has(id)) continue;
        fill_with(id, 0, 0, 0);
        for (size_t i = 0; i < count(); ++i)
            global(id, 0)[i] = float(std::fabs(change(row(of, 0), i, partial)));
    }
    if (!has(Global::P)) fill_with(Global::P, 0, 0, 0);
    find_edges(false);
    if (!has(Global::Ng)) {
        fill_with(Global::Ng, 0, 0, 1);
        auto at = [&](Global id, size_t i) {
            return vec3(row(id, 0)[i], row(id, 1)[i], row(id, 2)[i]);
        };
        for (size_t i = 0; i < count(); ++i) {
            vec3 across = glm::cross(at(Global::dPdu, i), at(Global::dPdv, i));
            float length = glm::length(across);
            for (int c = 0; c < 3 && length > 0; ++c) global(Global::Ng, c)[i] = across[c] / length;
        }
    }
    for (Global id : kGivenUniform)
        if (!has(id)) fill_with(id, 0, 0, 0);
    for (int c = 0; c < 3; ++c) {
        if (global(Global::N, c).empty()) global(Global::N, c) = global(Global::Ng, c);
        if (Row& I = global(Global::I, c); I.empty()) {
            I = global(Global::P, c);
            for (float& x : I) x -= global(Global::E, c)[0];
        }
        global(Global::Ps, c) = global(Global::P, c);
        global(Global::Ns, c) = global(Global::N, c);
    }
}

void PointSet::set(Global id, const std::vector<float>* components) {
    for (int c = 0; c < 3; ++c) {
        global(id, c) = components[c];
        if (id == Global::P) global(Global::Ps, c) = components[c];
        if (id == Global::N) global(Global::Ns, c) = components[c];
    }
    if (id == Global::P && document_.columns > 0) find_edges(true);
}

void PointSet::fill(const rsl::KernelKey& key, const PointsNumbers& numbers,
                    const dmat4& shader_space, std::span<float> out) const {
    Row row(count(), 0.0f);
    if (key.kind == KeyKind::One) std::fill(row.begin(), row.end(), 1.0f);
    if (key.kind == KeyKind::Global && key.component < 3 && has(key.global()))
        row = rows_[size_t(key.global())][key.component];
    if (key.kind == KeyKind::Rng)
        for (size_t i = 0; i < count(); ++i)
            row[i] = jit::float_of(int32_t(raytrace::hash(uint32_t(i), 0x9e3779b9u, 1)));
    if (key.kind == KeyKind::Parameter) {
        auto found = numbers.varying.find({key.layer, key.name});
        if (found != numbers.varying.end()) {
            const std::vector<double>& values = found->second.value.numbers;
            size_t width = found->second.per_point ? values.size() / count() : 0;
            size_t index = size_t(rsl::number_index(key));
            for (size_t i = 0; i < count(); ++i) row[i] = float(values[i * width + index]);
        }
    }
    if (key.is_space()) std::fill(row.begin(), row.end(), frame_number(key, numbers, shader_space));
    if (key.partial != Partial::None) row = along(row, key.partial);
    for (size_t i = 0; i < out.size(); ++i) out[i] = row[std::min(i, count() - 1)];
}

float PointSet::frame_number(const rsl::KernelKey& key, const PointsNumbers& numbers,
                             const dmat4& shader_space) const {
    if (key.kind == KeyKind::Parameter) {
        auto found = numbers.uniform.find(key);
        return found == numbers.uniform.end() ? 0.0f : found->second;
    }
    if (key.kind == KeyKind::Global) {
        if (key.global() == Global::ncomps) return 3;
        if (key.global() == Global::alpha) return 1;
        return has(key.global()) ? rows_[size_t(key.global())][key.component][0] : 0.0f;
    }
    if (key.kind == KeyKind::CameraNear) return 1;
    if (key.kind == KeyKind::CameraFar) return 2;
    if (!key.is_space()) return 0;
    dmat4 m = rsl::name_of(key) == "shader" ? shader_space : current_from_space(rsl::name_of(key));
    if (key.kind == KeyKind::SpaceFromCurrent) m = glm::inverse(m);
    return float(m[key.column()][key.row()]);
}

}  // namespace kinora
