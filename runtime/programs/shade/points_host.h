// runtime/programs/shade/points_host.h: what answers kernels that run over --points: spaces,
// options, attributes and lights of the file; rays meet nothing.
#pragma once

#include "runtime/base/arena.h"
#include "runtime/programs/shade/point_set.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/kernels/kernel_host.h"
#include "runtime/scene/shaders/printed_lines.h"

namespace kinora {

class PointsLights;

class PointsHost : public WorldHost {
  public:
    PointsHost(const PointSet& points, TextureStore& textures, PointsLights* lights);

    void set_shader_space(const dmat4& current_from_shader) { shader_space_ = current_from_shader; }
    const dmat4& shader_space() const { return shader_space_; }
    // Record sets, of which the first holds the lights at the points.
    std::span<const jit::RecordSet> at_points(Arena& arena);

    TextureStore& textures() const override { return textures_; }
    dmat4 current_from_space(std::string_view name, size_t point) const override;
    dmat4 world_from_current() const override;
    void print(const jit::ServiceCall& call) override;
    const PrintedLines& printed() const { return printed_; }
    void lights(const jit::ServiceCall& call) override;
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    void query(const jit::ServiceCall& call) override;
    KINORA_UNANSWERED(occlusion)
    KINORA_UNANSWERED(indirectdiffuse)
    KINORA_UNANSWERED(raylimit)
    KINORA_UNANSWERED(samplinglights)
    KINORA_UNANSWERED(samplewish)
    KINORA_UNANSWERED(lightsample)
    KINORA_UNANSWERED(bake3d)
    KINORA_UNANSWERED(texture3d)
    KINORA_UNANSWERED(photons)

  private:
    const PointSet& points_;
    TextureStore& textures_;
    PointsLights* lights_;
    dmat4 shader_space_{1.0};
    PrintedLines printed_;
    Arena* arena_ = nullptr;
    Arena local_;  // records of one group of lanes
    int32_t group_ = -1;
    std::vector<jit::RecordSet> sets_;
    size_t next_set_ = 0;
};

}  // namespace kinora
