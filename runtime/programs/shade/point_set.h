// runtime/programs/shade/point_set.h: the points of --points as kernels read them, with what the
// file does not give (docs/shade.md#points).
#pragma once

#include <span>
#include <vector>

#include "runtime/programs/shade/points_binding.h"

namespace kinora {

class PointSet {
  public:
    // Throws PointsError where a variable has not the shape of its global.
    explicit PointSet(const PointsDocument& document);

    size_t count() const { return document_.count; }
    const PointsDocument& document() const { return document_; }
    dmat4 current_from_space(std::string_view name) const;

    // Fills a row of a point-rate input; `shader_space` is the one that "shader" means.
    void fill(const rsl::KernelKey& key, const PointsNumbers& numbers, const dmat4& shader_space,
              std::span<float> row) const;
    // The number of a frame-rate input.
    float frame_number(const rsl::KernelKey& key, const PointsNumbers& numbers,
                       const dmat4& shader_space) const;
    // A component of a global at all points.
    std::span<const float> row(rsl::Global id, int component) const;
    // After a displacement: a global's new rows. Edges of the surface follow a new P on a grid.
    void set(rsl::Global id, const std::vector<float>* components);

  private:
    using Row = std::vector<float>;
    Row& global(rsl::Global id, int component) { return rows_[size_t(id)][component]; }
    void given(rsl::Global id);
    void missing();
    // dPdu and dPdv by the grid.
    void find_edges(bool given_too);
    bool is_given(rsl::Global id) const {
        return document_.variables.count(std::string(rsl::global_info(id).name)) > 0;
    }
    bool has(rsl::Global id) const { return !rows_[size_t(id)][0].empty(); }
    void fill_with(rsl::Global id, float x, float y, float z);
    // The change of a row along the grid's columns or rows, for each unit of u or v.
    Row along(std::span<const float> values, rsl::Partial partial) const;
    double change(std::span<const float> values, size_t point, rsl::Partial partial) const;

    const PointsDocument& document_;
    Row rows_[size_t(rsl::Global::Count)][3];
};

}  // namespace kinora
