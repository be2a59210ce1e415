// runtime/scene/gltf/export/written_mesh.h: a mesh as floats hold it.
#pragma once

#include <memory>

#include "runtime/scene/build/shapes/mesh.h"
#include "runtime/scene/gltf/document/loss_report.h"

namespace kinora {

struct WrittenMesh {
    const MeshDefinition* definition;           // the description's, or `own`
    std::unique_ptr<const MeshDefinition> own;  // without what floats do not reach
    Mesh built;
    // Positions are written about this point: the mesh's own origin, or its centre where it lies so
    // far away that floats would bend its shape.
    dvec3 origin{0.0};
};

WrittenMesh written_mesh(const MeshDefinition& definition, LossReport& losses);

}  // namespace kinora
