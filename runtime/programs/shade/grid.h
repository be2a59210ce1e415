// runtime/programs/shade/grid.h: the points kinora-shade shades: a square or a sphere before
// a pinhole eye at the origin of "current" space, which looks along +z. Object, shader and world
// space are one: the square spans x, y = 0..1 at z = 0 there, the sphere has radius 1 about 0.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "rsl/model/kernel_keys.h"
#include "runtime/base/math.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/kernels/point_source.h"

namespace kinora {

struct PatchPoint {
    vec3 P{0}, dPdu{0}, dPdv{0}, N{0}, dNdu{0}, dNdv{0};  // current space
    float u = 0, v = 0, du = 0, dv = 0;
    float rng = 0;       // int, bit for bit
    uint32_t pixel = 0;  // row * width + column, rows from the top
};

class Patch {
  public:
    Patch(int width, int height, bool sphere);

    size_t count() const { return points_.size(); }
    const PatchPoint& operator[](size_t i) const { return points_[i]; }
    const dmat4& current_from_object() const { return current_from_object_; }
    // By name; one that is not standard is taken for the object's.
    dmat4 current_from_space(std::string_view name) const;
    // From now on "shader" space is a light's: 1 before the patch's middle, its z towards the
    // patch, where a light looks (flip: its -z).
    void set_light(bool flip);

    // What its shader may read.
    std::shared_ptr<TextureStore> textures = std::make_shared<TextureStore>();

  private:
    void add_square_point(int x, int y, uint32_t pixel);
    void add_sphere_point(int x, int y, uint32_t pixel);

    int width_, height_;
    bool sphere_;
    dmat4 current_from_object_{1.0}, current_from_shader_{1.0};
    std::vector<PatchPoint> points_;
};

// The points from `first` on.
class PatchPoints : public PointSource {
  public:
    explicit PatchPoints(const Patch& patch, size_t first = 0) : patch_(patch), first_(first) {}
    void fill(const PointColumns& columns) override;

  private:
    const Patch& patch_;
    size_t first_;
};

// The number of a frame-rate input that is no parameter.
float frame_number(const Patch& patch, const rsl::KernelKey& key);

}  // namespace kinora
