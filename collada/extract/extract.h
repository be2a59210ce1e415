// collada/extract/extract.h: from a document to the structs of collada/scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "collada/document/document.h"
#include "collada/document/placed_model.h"
#include "collada/scene/scene.h"

namespace kinora::collada {

struct ExtractOptions {
    // The tree that links may name: "" is the folder of the document. One that is given is that of
    // an archive: images are confined to it, too.
    std::string folder;
    std::vector<std::string> allow_external;  // further trees, allowed by the user
    bool confine = false;                     // images too; else they are read wherever they lie
    std::string scene_id;  // of the visual scene instead of <scene>'s; ignored if there is none
    // Shown instead of the visual scene: at their places about the first, whose document is the
    // root.
    std::vector<PlacedModel> models;
    std::optional<double> meter;    // instead of the root document's own
    std::optional<UpAxis> up_axis;  // likewise
    uint32_t max_documents = 256;
    uint64_t max_node_instances = 1'000'000;  // nodes after unrolling instance_node
    // For findings: reads what <scene> does not reach too, of the root document. Those items stand
    // behind the others in SceneData's lists (channels between them, in document order). A document
    // without a visual scene gives a SceneData without roots.
    bool everything = false;
};

// Makes the structs of what <scene> reaches, in one pass over what it needs. Findings go to
// `diag`; nothing is returned when there is nothing to show (no visual scene at all; SCENE_NONE).
// Calls check_elements on every document it reads.
std::optional<SceneData> extract(const Document& document, Diagnostics& diag,
                                 const ExtractOptions& options = {});

}  // namespace kinora::collada
