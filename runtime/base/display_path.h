// runtime/base/display_path.h: how findings name files that stand in a folder of our own making:
// the members of an unpacked archive are "scene.zae!textures/wood.png", not a path below /tmp.
#pragma once

#include <string>

namespace kinora {

// From now on findings write `name` where a path begins with `folder` and a '/', also when the
// folder is gone: its name is never used again. Process wide, thread-safe.
void show_folder_as(const std::string& folder, const std::string& name);

// `text` with every such beginning replaced, anywhere in it.
std::string display_path(std::string text);

}  // namespace kinora
