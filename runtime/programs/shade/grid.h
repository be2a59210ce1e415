// runtime/programs/shade/grid.h: the points kinora-shade shades: a square or a sphere before
// a pinhole eye at the origin of "current" space, which looks along +z. Object, shader and world
// space are one: the square spans x, y = 0..1 at z = 0 there, the sphere has radius 1 about 0.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "rsl/model/kernel_keys.h"
#include "runtime/base/math.h"
#include "runtime/images/texture_store.h"

namespace kinora {

struct PatchPoint {
    vec3 P{0}, dPdu{0}, dPdv{0}, N{0}, dNdu{0}, dNdv{0};  // current space
    vec3 zero{0};
    float u = 0, v = 0, du = 0, dv = 0, zero1 = 0, one = 1;
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

// A kernel input as a member of PatchPoint; the matrices of spaces are taken from the patch.
// `found` is false for parameters.
struct PatchInput {
    explicit PatchInput(const Patch& patch, const rsl::KernelKey& key);
    float value(const PatchPoint& point) const {
        return triple ? (point.*triple)[component] : single ? point.*single : fixed;
    }

    bool found = false;
    vec3 PatchPoint::*triple = nullptr;
    float PatchPoint::*single = nullptr;
    int component = 0;
    float fixed = 0;

  private:
    void find_global(const rsl::KernelKey& key);
};

// All inputs without spaces and parameters.
std::vector<rsl::KernelKey> patch_inputs();

// An entry of a space's matrix.
float space_entry(const Patch& patch, const rsl::KernelKey& key);

}  // namespace kinora
