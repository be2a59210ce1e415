// runtime/picture/shading/lighting/lamps.h: what is seen of surfaces that are lights
// (docs/lights.md).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/picture/shading/grid.h"

namespace kinora {

class KernelRunner;
class LightRecords;
struct AreaLight;

// Fills the columns of a light's kernel at hits of its mesh, lit: where their rays come from.
void fill_light_columns(Grid& lit, const ShadingFrame& frame);

class Lamps {
  public:
    Lamps(ShadingFrame& frame, KernelRunner& kernels, const LightRecords& lights);

    // Puts right what the kernel of a grid has left in Ci: a lamp without a surface of its own is
    // seen as it shines, and rays of diffuse light do not see what a lamp sends to their sender.
    void show(Grid& grid, raytrace::ShadeResult& result);

  private:
    void find_lamps();
    void find_counted();
    uint32_t number_of_set(std::vector<bool> surfaces, bool dome);
    bool is_counted(const Grid& grid, size_t point) const;
    // What lights send from each of the points to the origin of its ray, as a radiance.
    void find_radiance(Grid& grid, std::span<vec3> radiance, std::span<float> shares);
    void add_radiance(Grid& grid, size_t light, std::span<vec3> radiance);
    // How much of what the points emit their lights' samples have.
    void add_shares(const Grid& grid, const AreaLight& light, std::span<float> shares) const;
    void take_emission(Grid& grid, std::span<const float> shares, raytrace::ShadeResult& result);

    ShadingFrame& frame_;
    KernelRunner& kernels_;
    const LightRecords& lights_;
    std::vector<std::vector<size_t>> of_surface_;  // lights of each surface
    std::vector<bool> wears_, made_;  // looks that lamps wear; of these, those made for lamps
    // Surfaces whose light some look gets from the lights themselves, by ShadingFrame::counted.
    std::vector<std::vector<bool>> counted_;
};

}  // namespace kinora
