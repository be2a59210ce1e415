// runtime/gltf/export/content.cpp: what hangs on the nodes: meshes, cameras, lights.
#include "runtime/gltf/export/content.h"

#include <nlohmann/json.hpp>

#include "runtime/description/morph_weights.h"
#include "runtime/gltf/curves/trs.h"

namespace kinora {

// The first of a kind sits on the node itself, more on children.
uint32_t ContentWriter::free_node(uint32_t node, const char* key) {
    return document_.node(node).contains(key) ? document_.add_node(Json::object(), node) : node;
}

void ContentWriter::write_mesh(const MeshUse& use, uint32_t occurrence) {
    uint32_t mesh = meshes_.write(use);
    if (mesh == kNone) return;
    uint32_t node = occurrences_[occurrence].node;
    if (use.skin != kNone)
        node =
            document_.add_node(Json::object({{"name", description_.meshes[use.mesh].id}}), kNone);
    else if (!is_identity(use.conversion))
        node = nodes_.write_still(use.conversion, node);
    else
        node = free_node(node, "mesh");
    document_.node(node)["mesh"] = mesh;
    if (use.skin != kNone) {
        uint32_t skin = skins_.write(use, occurrence);
        document_.node(node)["skin"] = skin;
    }
    if (use.morph != kNone) {
        std::vector<double> weights(chain_targets(description_, use.morph));
        morph_weights(description_, description_.values, use.morph, weights);
        document_.node(node)["weights"] = weights;
        motion_.move_weights(node, use.morph);
    }
}

void ContentWriter::write(uint32_t occurrence) {
    const Occurrence& o = occurrences_[occurrence];
    const NodeDefinition& definition = description_.nodes[o.definition];
    for (const MeshUse& use : definition.meshes) write_mesh(use, occurrence);
    for (uint32_t c : definition.cameras) {
        uint32_t camera = cameras_.write(c);
        uint32_t node = free_node(o.node, "camera");
        document_.node(node)["camera"] = camera;
    }
    for (uint32_t l : definition.lights) {
        uint32_t light = lights_.write(l, o.world);
        uint32_t node = free_node(o.node, "extensions");
        document_.node(node)["extensions"]["KHR_lights_punctual"]["light"] = light;
    }
}

}  // namespace kinora
