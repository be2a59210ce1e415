// runtime/scene/images/map_distribution.h: directions as dense as an environment map is bright.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

struct LatlongPlaces;

// Directions are in the map's own space, of length 1: y is up, the picture's middle is along +z,
// and +x lies a quarter of its width left of that (texture.h).
class MapDistribution {
  public:
    // Of a map that is as bright everywhere.
    MapDistribution() = default;
    // Brightness of texels in rows from the top. What is not above 0, or is no number, counts as 0.
    MapDistribution(uint32_t columns, uint32_t rows, std::span<const float> brightness);

    // For u in [0, 1) squared. The density is by solid angle; 0 where the map is black throughout.
    vec3 direction(vec2 u, float& density) const;
    float density(vec3 direction) const;

    // The same of the lanes of `mask` of sixteen; the others are not written. `to`: rows of
    // x, y and z.
    void directions(uint32_t mask, const float* x, const float* y, float* to, float* density) const;
    void densities(uint32_t mask, const LatlongPlaces& places, float* to) const;

  private:
    struct Choice {
        uint32_t index;
        double within;  // what is left of the number: in [0, 1)
    };
    // In texels from the middle of the first one.
    struct Place {
        int column, row;      // the texel left of the place and above it
        float right, bottom;  // how near the next texels are: in [0, 1]
    };
    Choice choose_row(double u) const;
    Choice choose_column(uint32_t row, float u) const;
    void add_row(std::span<const float> brightness);
    float share_of_row(uint32_t row) const;
    float share(uint32_t row, uint32_t column) const;
    float chance(const Place& place) const;
    float by_solid_angle(float chance, float around) const;

    uint32_t columns_ = 0, rows_ = 0;  // none: as bright everywhere
    std::vector<double> below_row_;    // light of the rows before and with each, summed
    std::vector<float> below_;         // of a row's: shares of the texels before and with each
    // Of a row, by cells of equal width from 0 to 1: its first texel whose number in below_ lies in
    // that cell or a later one.
    std::vector<uint32_t> first_in_cell_;
};

}  // namespace kinora
