// runtime/scene/ri/meshes/mesh_store.cpp: meshes by what they are of.
#include "runtime/scene/ri/meshes/mesh_store.h"

namespace kinora::ri {

std::shared_ptr<const MeshDefinition> MeshStore::find(const MeshKey& key) {
    auto known = entries_.find(key);
    if (known == entries_.end()) return nullptr;
    known->second.used = world_;
    return known->second.mesh;
}

void MeshStore::keep(const MeshKey& key, const MeshDefinition& mesh) {
    entries_.insert_or_assign(key, Entry{std::make_shared<MeshDefinition>(mesh), world_});
}

void MeshStore::begin_world() {
    std::erase_if(entries_, [&](const auto& entry) { return entry.second.used + 1 < world_; });
    ++world_;
}

}  // namespace kinora::ri
