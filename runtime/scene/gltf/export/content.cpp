// runtime/scene/gltf/export/content.cpp: what hangs on the nodes: meshes, cameras, lights.
#include "runtime/scene/gltf/export/content.h"

#include <glm/ext/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/gltf/curves/trs.h"

namespace kinora {

// The first of a kind sits on the node itself, more on children.
uint32_t ContentWriter::free_node(uint32_t node, const char* pointer) {
    bool taken = document_.node(node).contains(Json::json_pointer(pointer));
    return taken ? document_.add_node(Json::object(), node) : node;
}

void ContentWriter::write_mesh(const MeshUse& use, uint32_t occurrence) {
    uint32_t mesh = meshes_.write(use);
    if (mesh == kNone) return;
    uint32_t node = occurrences_[occurrence].node;
    dmat4 about = glm::translate(dmat4(1.0), meshes_.origin(use.mesh));
    dmat4 placed = use.conversion * about;
    if (use.skin != kNone) {
        node =
            document_.add_node(Json::object({{"name", description_.meshes[use.mesh].id}}), kNone);
        if (occurrences_[occurrence].hidden) document_.hide(node);
    } else if (!is_identity(placed)) {
        node = nodes_.write_still(placed, node);
    } else {
        node = free_node(node, "/mesh");
    }
    document_.node(node)["mesh"] = mesh;
    if (use.skin != kNone) {
        uint32_t skin = skins_.write(use, about, occurrence);
        document_.node(node)["skin"] = skin;
    }
    size_t targets = use.morph == kNone ? 0 : chain_targets(description_, use.morph);
    if (targets > 0) {
        std::vector<double> weights(targets);
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
        uint32_t node = free_node(o.node, "/camera");
        document_.node(node)["camera"] = camera;
    }
    for (uint32_t l : definition.lights) {
        uint32_t light = lights_.write(l, o.world);
        uint32_t node = free_node(o.node, "/extensions/KHR_lights_punctual");
        document_.node(node)["extensions"]["KHR_lights_punctual"]["light"] = light;
    }
}

}  // namespace kinora
