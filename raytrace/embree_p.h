// raytrace/embree_p.h: the few things we ask of Embree, without its types. Private to raytrace/.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "raytrace/accel.h"

namespace kinora::raytrace {

enum class BuildQuality : uint8_t { Low, Medium, Refit };

// What a candidate hit is compared by and turned into: from Embree's (instance, geometry,
// primitive) to the caller's row and primitive.
struct HitMap {
    struct Slot {
        const uint32_t* owner = nullptr;  // row of each primitive (concatenated rows), or null:
        uint32_t row = 0;                 // ... the one row of the slot
        bool hide_backfaces = false;
    };
    struct Row {
        uint32_t id = 0;
        uint32_t body = 0;
        uint32_t first_primitive = 0;  // within its slot
        bool mirrored = false;
        bool instanced = false;
        float normal[9] = {};  // instanced: accel normal from local normal, row by row
    };
    std::vector<Slot> slots;  // by the id it was attached with
    std::vector<Row> rows;
};

// One triangle mesh. Positions are read in place (16-byte stride), triangles too. With a `scale`
// other than 1 (scale_p.h) positions are copied and scaled.
class EmbreeMesh {
  public:
    EmbreeMesh() = default;
    EmbreeMesh(std::span<const vec4> positions, std::span<const uint32_t> triangles,
               BuildQuality quality, uint32_t mask, bool filtered, float scale);
    EmbreeMesh(EmbreeMesh&& o) noexcept { *this = std::move(o); }
    EmbreeMesh& operator=(EmbreeMesh&& o) noexcept {
        std::swap(geometry_, o.geometry_);
        std::swap(positions_, o.positions_);
        std::swap(scale_, o.scale_);
        std::swap(scaled_, o.scaled_);
        return *this;
    }
    ~EmbreeMesh();
    void vertices_moved();                                    // in place
    void vertices_moved_to(std::span<const vec4> positions);  // another buffer, same topology

  private:
    friend class EmbreeScene;
    std::span<const vec4> traced();  // positions_ as Embree sees them
    void* geometry_ = nullptr;
    std::span<const vec4> positions_;
    float scale_ = 1;
    std::vector<vec4> scaled_;  // empty where the scale is 1
};

class EmbreeScene;
class EmbreeInstance {
  public:
    EmbreeInstance() = default;
    EmbreeInstance(const EmbreeScene& scene, uint32_t mask);
    EmbreeInstance(EmbreeInstance&& o) noexcept : geometry_(std::exchange(o.geometry_, nullptr)) {}
    EmbreeInstance& operator=(EmbreeInstance&& o) noexcept {
        std::swap(geometry_, o.geometry_);
        return *this;
    }
    ~EmbreeInstance();
    void set_matrix(const float columns[12]);  // and what it instances may have changed
    bool has_extent() const;                   // of its box, as Embree rounds it; slow

  private:
    friend class EmbreeScene;
    void* geometry_ = nullptr;
};

// `dynamic`: of LOW quality as a whole, which is what makes Embree honour each mesh's own quality
// (REFIT and LOW are otherwise silently rebuilt as MEDIUM).
class EmbreeScene {
  public:
    EmbreeScene() = default;
    EmbreeScene(bool dynamic, bool robust);
    EmbreeScene(EmbreeScene&& o) noexcept : scene_(std::exchange(o.scene_, nullptr)) {}
    EmbreeScene& operator=(EmbreeScene&& o) noexcept {
        std::swap(scene_, o.scene_);
        return *this;
    }
    ~EmbreeScene();
    explicit operator bool() const { return scene_ != nullptr; }

    void attach(const EmbreeMesh& mesh, uint32_t slot);
    void attach(const EmbreeInstance& instance, uint32_t slot);
    void detach(uint32_t slot);
    void commit();
    // Of all that is attached, since the last commit; low above high where nothing is.
    void bounds(vec3& low, vec3& high) const;

    // The rays must be well-formed. Fill hits (geometry = kNone for misses), give the lanes' bits.
    uint32_t intersect16(const RayPacket16& rays, const HitMap& map, bool fixed_winner,
                         HitPacket16& hits) const;
    uint32_t occluded16(const RayPacket16& rays) const;

  private:
    friend class EmbreeInstance;
    void* scene_ = nullptr;
};

}  // namespace kinora::raytrace
