// runtime/picture/shading/rays/map_tables.h: tables of the brightness of environment maps, each made
// when it is first asked for.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>

#include "runtime/scene/images/environment_table.h"

namespace kinora {

class TextureStore;

class MapTables {
  public:
    explicit MapTables(TextureStore& store) : store_(store) {}
    // Null where even directions find as much.
    const EnvironmentTable* find(int32_t map);

  private:
    TextureStore& store_;
    std::mutex mutex_;
    std::map<int32_t, EnvironmentTable> tables_;
};

}  // namespace kinora
