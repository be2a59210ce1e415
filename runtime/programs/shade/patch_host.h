// runtime/programs/shade/patch_host.h: the world around a patch: two lights, textures, nothing for
// rays to meet.
#pragma once

#include <vector>

#include "rsl/model/renderer_services.h"
#include "runtime/programs/shade/grid.h"
#include "runtime/scene/kernels/kernel_host.h"
#include "runtime/scene/shaders/printed_lines.h"

namespace kinora {

// Record sets that the services `lights` and `gather` name.
enum PatchRecordSet : int32_t { kPatchLights, kNoRays, kPatchRecordSets };

class PatchHost : public WorldHost {
  public:
    // `prints` takes what the shader prints.
    PatchHost(const Patch& patch, PrintedLines& prints) : patch_(patch), prints_(prints) {}

    TextureStore& textures() const override { return *patch_.textures; }
    dmat4 current_from_space(std::string_view name, size_t point) const override;
    dmat4 world_from_current() const override;
    void print(const jit::ServiceCall& call) override;
    void lights(const jit::ServiceCall& call) override;
    void trace(const jit::ServiceCall& call) override;
    void transmission(const jit::ServiceCall& call) override;
    void gather(const jit::ServiceCall& call) override;
    KINORA_UNANSWERED(occlusion)
    KINORA_UNANSWERED(indirectdiffuse)
    KINORA_UNANSWERED(raylimit)
    KINORA_UNANSWERED(samplinglights)
    KINORA_UNANSWERED(samplewish)
    KINORA_UNANSWERED(lightsample)
    KINORA_UNANSWERED(query)
    KINORA_UNANSWERED(bake3d)
    KINORA_UNANSWERED(texture3d)
    KINORA_UNANSWERED(photons)

  private:
    const Patch& patch_;
    PrintedLines& prints_;
};

// The light that shines on the patch: what kinora-shade's surfaces see.
struct ShadeLight {
    rsl::LightKind kind;
    vec3 L;  // to the light, current space
    vec3 Cl;
};
std::vector<ShadeLight> shade_lights();

}  // namespace kinora
