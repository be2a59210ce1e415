// collada/lint_textures.cpp: samplers of the other version; textures and the texture coordinates
// that instances give them.
#include <set>

#include "collada/lint_p.h"

namespace kinora::collada {

namespace {

void check_versions(Lint& lint) {
    if (lint.document.version() == Version::V1_5_0) {
        for (const Element* param : lint.named("newparam"))
            for (const Element& value : param->children()) {
                bool sampler = value.name.starts_with("sampler") && value.child("source");
                if (sampler || value.name == "surface")
                    lint.diag.report(Code::TEX_SURFACE_1_5, lint.where(value),
                                     sampler ? "<source> of a sampler" : "<surface>");
            }
        return;
    }
    for (const Element* instance : lint.named("instance_image"))
        lint.diag.report(Code::TEX_INSTANCE_IMAGE_1_4, lint.where(*instance));
}

// One <instance_material> of a mesh: what its textures ask for.
class BindingCheck {
  public:
    BindingCheck(Lint& lint, const MeshInstance& mesh, const MaterialBinding& binding)
        : lint_(lint),
          binding_(binding),
          material_(lint.scene.materials[binding.material]),
          geometry_(lint.scene.geometries[mesh.geometry]) {}

    void run() {
        const Effect& effect = lint_.scene.effects[material_.effect];
        if (!effect.common || effect.rsl) return;
        std::set<std::string_view> seen;
        for (const CommonValue& value : effect.common->slots)
            if (value.source == SlotSource::Texture && seen.insert(value.texcoord).second)
                check_texture(value.texcoord);
    }

  private:
    void check_texture(std::string_view texcoord) {
        const VertexInputBinding* bound = nullptr;
        for (const VertexInputBinding& input : binding_.vertex_inputs)
            if (input.semantic == texcoord) bound = &input;
        if (bound) return check_set(*bound);
        std::string_view label = material_.id;
        if (!has_input("TEXCOORD", kNone))
            lint_.diag.report(Code::TEX_SET_MISSING, binding_.where, "TEXCOORD", label);
        else if (!texcoord.empty())
            lint_.diag.report(Code::TEX_NO_BVI, binding_.where, label, texcoord);
    }
    void check_set(const VertexInputBinding& bound) {
        if (has_input(bound.input_semantic, bound.input_set)) return;
        std::string wanted = bound.input_semantic;
        if (bound.input_set != kNone && has_input(bound.input_semantic, kNone))
            wanted += fmt::format(" of set {}", bound.input_set);
        lint_.diag.report(Code::TEX_SET_MISSING, bound.where, wanted, material_.id);
    }
    // In all primitives with the symbol; true if there are none.
    bool has_input(std::string_view semantic, uint32_t set) const {
        for (const PrimitiveGroup& group : geometry_.groups) {
            if (group.material != binding_.symbol) continue;
            bool has = false;
            for (const VertexInput& input : group.inputs)
                has = has || (input.semantic == semantic && (set == kNone || input.set == set));
            if (!has) return false;
        }
        return true;
    }

    Lint& lint_;
    const MaterialBinding& binding_;
    const Material& material_;
    const Geometry& geometry_;
};

}  // namespace

void lint_textures(Lint& lint) {
    check_versions(lint);
    for (const Node& node : lint.scene.nodes)
        for (const MeshInstance& mesh : node.meshes)
            for (const MaterialBinding& binding : mesh.materials)
                if (binding.material != kNone &&
                    lint.scene.materials[binding.material].effect != kNone)
                    BindingCheck(lint, mesh, binding).run();
}

}  // namespace kinora::collada
