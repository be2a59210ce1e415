// runtime/scene/gltf/import/unique_ids.h: ids of definitions.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

namespace kinora {

// A name may stand for several things; an id is one thing's.
class UniqueIds {
  public:
    std::string id(const std::string& name, const char* kind, size_t index) {
        std::string id = name.empty() ? fmt::format("{}_{}", kind, index) : name;
        if (taken_.emplace(kind, id).second) return id;
        id += fmt::format(".{}", index);
        taken_.emplace(kind, id);
        return id;
    }

  private:
    std::set<std::pair<std::string, std::string>> taken_;  // kind, id
};

}  // namespace kinora
