// runtime/scene/shaders/scene_host.h: a scene's answers to its kernels: wherever they run, at frame
// rate and at vertices.
#pragma once

#include "runtime/scene/kernels/kernel_host.h"
#include "runtime/scene/shaders/printed_lines.h"

namespace kinora {

struct Pose;
struct Scene;
struct ShaderInstance;

// What a scene answers wherever its kernel runs.
class SceneHost : public WorldHost {
  public:
    SceneHost(const Scene& scene, const Pose& pose, const ShaderInstance& look)
        : scene_(scene), pose_(pose), look_(look) {}

    TextureStore& textures() const override;
    TextureFilter best_filter() const override;
    dmat4 current_from_space(std::string_view name, size_t point) const override;
    dmat4 world_from_current() const override;
    void texture3d(const jit::ServiceCall& call) override;
    void photons(const jit::ServiceCall& call) override;

  protected:
    const Scene& scene_;
    const Pose& pose_;
    const ShaderInstance& look_;
};

// A kernel that does not run at points of a picture: no lights, no rays, nothing is baked.
class UnlitHost : public SceneHost {
  public:
    using SceneHost::SceneHost;
    void query(const jit::ServiceCall& call) override;
    KINORA_UNANSWERED(lights)
    KINORA_UNANSWERED(trace)
    KINORA_UNANSWERED(transmission)
    KINORA_UNANSWERED(occlusion)
    KINORA_UNANSWERED(indirectdiffuse)
    KINORA_UNANSWERED(gather)
    KINORA_UNANSWERED(raylimit)
    KINORA_UNANSWERED(samplinglights)
    KINORA_UNANSWERED(samplewish)
    KINORA_UNANSWERED(lightsample)
    KINORA_UNANSWERED(bake3d)
};

// A shader instance at frame rate.
class FrameHost : public UnlitHost {
  public:
    using UnlitHost::UnlitHost;
    // Once per instance and frame; show_printed() shows it.
    void print(const jit::ServiceCall& call) override;
    const PrintedLines& printed() const { return printed_; }
    void show_printed() const;

  private:
    PrintedLines printed_;
};

// A kernel that moves vertices: "current" is the space of `object`, a scene node.
class VertexHost : public UnlitHost {
  public:
    VertexHost(const Scene& scene, const Pose& pose, const ShaderInstance& look, uint32_t object,
               PrintedLines& prints)
        : UnlitHost(scene, pose, look), object_(object), prints_(prints) {}

    dmat4 current_from_space(std::string_view name, size_t point) const override;
    void print(const jit::ServiceCall& call) override;

  private:
    uint32_t object_;
    PrintedLines& prints_;  // of this part of the vertices
};

}  // namespace kinora
