// runtime/programs/convert/write_whole_p.h: files that are whole where they have their name.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// Writes to a temporary name beside the output, then renames. Returns an exit code; what failed is
// printed. Folders of the path are made.
int write_whole(const std::string& path, std::string_view bytes);

}  // namespace kinora
