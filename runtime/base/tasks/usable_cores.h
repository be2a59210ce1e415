// runtime/base/tasks/usable_cores.h: how many cores this process may use, which is what it runs
// threads on by default.
#pragma once

#include <optional>
#include <string>

namespace kinora {

// The cores of the process's affinity, or those that its control groups pay for, whichever are
// fewer. At least 1.
int usable_cores();

// The processor time that control groups grant the process, in cores: 1.5 is 150 ms in each 100 ms.
// The least of the process's group and of those above it, in version 1 and 2. Nothing where there
// is no limit. `root` stands before the paths of /proc/self and of the mounted hierarchies.
std::optional<double> granted_cores(const std::string& root = "");

}  // namespace kinora
